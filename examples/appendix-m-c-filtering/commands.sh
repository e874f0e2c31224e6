microstructure spray 100 100 100 1 dump.spray-100-1-5.1.spn
sculpt -i dump.spray-100-1-5.1.i -j 16
eputool -p 16 dump.spray-100-1-5.1
