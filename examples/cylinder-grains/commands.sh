hexmesh cylinder --n 12 --layers 36 --grains 12 cylinder.g
sculpt -i cylinder_grains.i -j 2
eputool -p 2 cylinder_grains
