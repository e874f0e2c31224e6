microstructure balls 26 26 26 8 1 balls.spn
hexmesh nested multi_blocks.g
sculpt -i multi_blocks.i -j 2
eputool -p 2 multi_blocks

# The same from files that SEACAS decomposed, where it is installed.
if command -v decomp; then
  decomp -p 4 multi_blocks.g
  sculpt -i multi_blocks.i -e multi_blocks_decomposed -j 4
  eputool -p 4 multi_blocks_decomposed
fi
