$ TwoPhase.i Sculpt input file to generate 2-phase microstructure
BEGIN SCULPT
  input_spn = TwoPhase.spn
  exodus_file = TwoPhase

  $ number of cells (required)
  nelx = 64
  nely = 64
  nelz = 64

  $ smoothing options
  smooth = fixed_bbox
  csmooth = vfrac
  laplacian_iters = 10
  max_opt_iters = 20
END SCULPT
