$ Every shape of diatom files as a material of its own.
BEGIN SCULPT
  diatom_file = shapes.diatom
  exodus_file = shapes
  xmin = 0
  ymin = 0
  zmin = 0
  xmax = 15
  ymax = 18
  zmax = 3
  nelx = 90
  nely = 108
  nelz = 18
  compare_volume = true
END SCULPT
