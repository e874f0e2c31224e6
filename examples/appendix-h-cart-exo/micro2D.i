$ micro2D.i Sculpt input file for 2D microstructure
BEGIN SCULPT
  input_cart_exo = micro2D.e
  exodus_file = micro_3D
END SCULPT
