$ grains.i: twenty grains on a grid of 24 x 24 x 24 cells
BEGIN SCULPT
  input_spn = grains.spn
  nelx = 24
  nely = 24
  nelz = 24
  exodus_file = grains
END SCULPT
