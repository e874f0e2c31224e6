$ Sculpt input file: a periodic mesh
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
  periodic = true
  periodic_nodesets = 1 2 3 4 5 6
  gen_sidesets = rve
  exodus_file = spheres_periodic
  mesh_void = true
END SCULPT
