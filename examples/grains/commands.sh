microstructure grains 24 24 24 20 1 grains.spn
sculpt -i grains.i -j 2
eputool -p 2 grains
