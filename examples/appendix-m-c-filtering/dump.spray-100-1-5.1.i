$ dump.spray-100-1-5.1.i Sculpt input file for generating thermal spray mesh
BEGIN SCULPT
  input_spn = dump.spray-100-1-5.1.spn
  nelx = 100
  nely = 100
  nelz = 100
  exodus_file = dump.spray-100-1-5.1
  defeature = 1
  defeature_iters = 20
  smooth = 3
  csmooth = 4
  laplacian_iters = 2
  curve_opt_thresh = 0.2
  thicken_material = 3 0.2
  thicken_material = 1 0.33
  compare_volume = true
END SCULPT
