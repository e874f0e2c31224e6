microstructure phases 64 64 64 3 1 TwoPhase.spn
sculpt -i TwoPhase.i -j 4
eputool -p 4 TwoPhase
