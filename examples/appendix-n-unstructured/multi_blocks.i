$ multi_blocks.i Sculpt input file using an unstructured overlay grid
BEGIN SCULPT
  input_spn = balls.spn
  nelx = 26
  nely = 26
  nelz = 26
  input_mesh = multi_blocks.g
  input_mesh_blocks = 2 4
  exodus_file = multi_blocks
  mesh_void = true
  laplacian_iters = 2
  smooth = 3
  csmooth = 4
  defeature = 1
END SCULPT
