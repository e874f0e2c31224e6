// hexmesh KIND [--option value ...] FILE.g: makes the hex meshes of examples and tests. The same command
// gives the same mesh on every machine.
#include <cstdio>
#include <exception>
#include <string>

#include "kinds.hpp"

namespace {

void print_help() {
  std::puts("Usage: hexmesh KIND [--option value ...] FILE.g\n\nKinds:");
  for (const hexmesh::Kind& k : hexmesh::all_kinds()) std::printf("  %s %s\n", k.name, k.help);
  std::puts(
      "\nFor all kinds:\n"
      "  --grains N     a polycrystal of N grains as element variables vf_1 .. vf_N, mixed at grain "
      "boundaries\n"
      "  --seed S       of the grains (1)\n"
      "  --permute S    nodes, and hexes within their blocks, in a shuffled order");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2 || std::string(argv[1]) == "-h" || std::string(argv[1]) == "--help") {
      print_help();
      return argc < 2 ? 1 : 0;
    }
    const hexmesh::Kind& kind = hexmesh::kind_named(argv[1]);
    hexmesh::Options options({argv + 2, argv + argc});
    const hexmesh::Mesh mesh = make_mesh(kind, options);
    const std::string file = options.file();
    write_mesh(file, mesh, std::string("hexmesh ") + kind.name);
    std::printf("%s: %zu hexes, %zu nodes, %zu blocks\n", file.c_str(), mesh.hex.size(), mesh.node.size(),
                mesh.blocks.size());
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "hexmesh: %s\n", e.what());
    return 1;
  }
}
