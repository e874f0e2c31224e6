$ spheres_periodic.i Sculpt input file demonstrating periodic meshing
BEGIN SCULPT
  diatom_file = spheres_periodic.diatom
  xmin = -18.705510
  ymin = -18.705510
  zmin = -18.705510
  xmax = 18.705510
  ymax = 18.705510
  zmax = 18.705510
  nelx = 38
  nely = 38
  nelz = 38
  adapt_type = vfrac_average
  adapt_levels = 1
  adapt_threshold = 0.0001
  periodic = true
  exodus_file = spheres_periodic
  mesh_void = true
END SCULPT
