$ Fine near the interfaces, coarse inside the phases
BEGIN SCULPT
    input_spn = phases.spn
    exodus_file = coarsen
    nelx = 96
    nely = 96
    nelz = 96
    adapt_type = coarsen
    adapt_levels = 3
END SCULPT
