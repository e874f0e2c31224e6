sculpt -i cylinder.i -j 2
eputool -p 2 pamgen_cylinder
sculpt -i sphere.i -j 2
eputool -p 2 pamgen_sphere
