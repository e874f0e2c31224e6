$ Sculpt input file: two_spheres.i
BEGIN SCULPT
    diatom_file = two_spheres.diatom
    exodus_file = two_spheres
    xmin = -15
    ymin = -10
    zmin = -10
    xmax = 15
    ymax = 10
    zmax = 0
    nelx = 30
    nely = 20
    nelz = 10
    smooth = fixed_bbox
    mesh_void = true
    void_mat = 6
    adapt_type = vfrac_average
    adapt_threshold = 0.0001
    adapt_levels = 2
    pillow_boundaries = true
END SCULPT
