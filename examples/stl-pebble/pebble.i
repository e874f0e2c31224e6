$ pebble.i: a hollow body from an STL file, with a ball in the hollow and another one that cuts into its side
BEGIN SCULPT
  diatom_file = pebble.diatom
  exodus_file = pebble
  nelx = 60
  nely = 60
  nelz = 60
  xmin = -1.8
  ymin = -1.8
  zmin = -1.8
  xmax = 1.8
  ymax = 1.8
  zmax = 1.8
  smooth = to_geometry
  compare_volume = true
END SCULPT
