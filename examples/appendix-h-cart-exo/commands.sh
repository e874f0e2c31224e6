microstructure grains 60 60 1 20 1 micro2D.spn
sculpt -i micro2D-cells.i
eputool -p 1 micro2D
sculpt -i micro2D.i -j 8
eputool -p 8 micro_3D
