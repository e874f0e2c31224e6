microstructure pebble 7 4 pebble.stl
sculpt -i pebble.i -j 2
eputool -p 2 pebble
