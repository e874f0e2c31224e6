$ An angle bracket with two holes: edges and corners stay sharp.
BEGIN SCULPT
  stl_file = bracket.stl
  exodus_file = capture
  nelx = 34
  nely = 34
  nelz = 36
  xmin = -0.6
  ymin = -0.6
  zmin = -0.1
  xmax = 2.12
  ymax = 2.12
  zmax = 2.78
  capture = 5
  gen_sidesets = geometric_surfaces
  compare_volume = true
END SCULPT
