sculpt -i spheres_periodic.i -j 16
eputool -p 16 spheres_periodic
