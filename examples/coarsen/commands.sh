microstructure phases 96 96 96 20 1 phases.spn
sculpt -i coarsen.i -j 2
eputool -p 2 coarsen
