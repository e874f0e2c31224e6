solid sphere --levels 0 --radius 1.25 octahedron.stl
sculpt -i shapes.i
eputool -p 1 shapes
