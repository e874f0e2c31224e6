$ micro2D-cells.i turns the voxels of micro2D.spn into the Exodus grid micro2D.e
BEGIN SCULPT
  input_spn = micro2D.spn
  nelx = 60
  nely = 60
  nelz = 1
  stair = fast
  exodus_file = micro2D
END SCULPT
