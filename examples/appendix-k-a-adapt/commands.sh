sculpt -i two_spheres.i
eputool -p 1 two_spheres
