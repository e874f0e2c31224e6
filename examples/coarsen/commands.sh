microstructure phases 128 128 128 29 2 phases.spn
sculpt -i coarsen.i -j 2
eputool -p 2 coarsen
