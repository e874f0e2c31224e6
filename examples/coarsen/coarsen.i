$ Fine near the interfaces, coarse inside the phases
BEGIN SCULPT
    input_spn = phases.spn
    exodus_file = coarsen
    nelx = 128
    nely = 128
    nelz = 128
    adapt_type = coarsen
    adapt_levels = 3
END SCULPT
