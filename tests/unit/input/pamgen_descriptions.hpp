#pragma once
// Descriptions of meshes in the language of Pamgen.

namespace sculpt::test {

inline constexpr const char* kRectilinear = R"(mesh
  rectilinear
    nx = 4
    ny = 5
    nz = 6
    bx = 2
    by = 1
    bz = 2
    gmin = 0.0 0.1 0.0
    gmax = 1.0 2.0 3.0
  end
  set assign
    sideset, ihi, 10
    nodeset, jlo, 20
    block sideset, ihi, 30, 1
  end
end
)";

inline constexpr const char* kBrick = R"(mesh
  brick
    numx 2
      xblock 1 1.0 interval 4
      xblock 2 2.0 first size 0.1 last size 0.4
    numy 1
      yblock 1 1.0 interval 5
    numz 1
      zblock 1 1.0 interval 3
  end
end
)";

inline constexpr const char* kCylinder = R"($ radius 3, height 2
mesh
  radial trisection
    trisection blocks, 4
    transition radius, 0.3
    numz 1
      zblock 1 2.0 interval 6
    numr 2
      rblock 1 1.0 interval 4
      rblock 2 2.0 interval 4
    numa 1
      ablock 1 360. interval 24
  end
  set assign
    sideset, ihi, 10
    nodeset, klo, 20
  end
end
)";

inline constexpr const char* kSphere = R"(mesh
  spherical
    nr = 6
    ntheta = 8
    nphi = 8
    br = 1
    btheta = 1
    bphi = 1
    gmin = 0.5 45.0 -45.0
    gmax = 1.0 135.0 45.0
  end
  set assign
    sideset, ihi, 10
  end
end
)";

inline constexpr const char* kTransformed = R"(mesh
  rectilinear
    nx = 4
    ny = 4
    nz = 4
    bx = 1
    by = 1
    bz = 1
    gmin = 0 0 0
    gmax = 1 1 1
  end
  user defined geometry transformation
    "
    outxcoord = inxcoord + 0.1*inycoord;
    outycoord = inycoord;
    outzcoord = 2.0*inzcoord;
    "
  end
end
)";

}  // namespace sculpt::test
