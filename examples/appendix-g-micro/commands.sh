microstructure fractions 96 96 96 20 1 micro.tec
sculpt -i micro.i -j 8
eputool -p 8 micro
