$ dump.spray-100-1-5.1-stair.i file for generating stair-step mesh
BEGIN SCULPT
  stair = fast
  input_spn = dump.spray-100-1-5.1.spn
  nelx = 100
  nely = 100
  nelz = 100
  exodus_file = dump.spray-100-1-5.1-stair
END SCULPT
