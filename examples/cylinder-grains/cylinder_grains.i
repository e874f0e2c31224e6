$ cylinder_grains.i: a polycrystal given as element variables of an unstructured mesh
BEGIN SCULPT
  input_mesh = cylinder.g
  exodus_file = cylinder_grains
END SCULPT
