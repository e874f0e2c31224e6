sculpt -i spheres_periodic.i -j 4
eputool -p 4 spheres_periodic
