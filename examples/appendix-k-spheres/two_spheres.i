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
    nelx = 60
    nely = 40
    nelz = 20
    smooth = fixed_bbox
    mesh_void = true
    void_mat = 6
END SCULPT
