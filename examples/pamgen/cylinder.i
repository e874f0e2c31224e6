$ cylinder.i: balls in a cylinder that Pamgen makes
BEGIN SCULPT
  input_mesh_pamgen = cylinder.pamgen
  diatom_file = cylinder.diatom
  exodus_file = pamgen_cylinder
  mesh_void = true
END SCULPT
