$ sphere.i: two balls in part of a spherical shell that Pamgen makes
BEGIN SCULPT
  input_mesh_pamgen = sphere.pamgen
  diatom_file = sphere.diatom
  exodus_file = pamgen_sphere
  mesh_void = true
END SCULPT
