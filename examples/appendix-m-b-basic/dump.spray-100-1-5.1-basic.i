$ dump.spray-100-1-5.1-basic.i Basic sculpt input file
BEGIN SCULPT
  input_spn = dump.spray-100-1-5.1.spn
  nelx = 100
  nely = 100
  nelz = 100
END SCULPT
