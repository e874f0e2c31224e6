#include "sculpt/input/pamgen.hpp"

#include <create_inline_mesh.h>
#include <fmt/core.h>
#include <pamgen_im_exodusII_l.h>
#include <pamgen_im_ne_nemesisI_l.h>

#include <algorithm>
#include <climits>
#include <numeric>
#include <utility>

#include "input/pamgen_trial.hpp"
#include "input/text_file.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr const char* kOption = "input_mesh_pamgen";

using Numbers = std::vector<long long>;

// Whether anything but comments is there.
bool says_something(const std::string& text) {
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') comment = false;
    if (c == '$' || c == '#') comment = true;
    if (!comment && c > ' ') return true;
  }
  return false;
}

// Rank 0 reads; all ranks have the text.
std::string read_text(const Comm& comm, const std::string& path) {
  std::string text;
  collectively(comm, "reading " + path, [&] {
    if (comm.rank() != 0) return;
    const TextFile file(path, kOption);
    text.resize(static_cast<std::size_t>(file.size()));
    file.read(0, text);
    if (!says_something(text)) throw Error(fmt::format("{}: '{}' has no description", kOption, path));
    if (text.find('\0') != std::string::npos)
      throw Error(fmt::format("{}: '{}' is not a text file", kOption, path));
  });
  return comm.broadcast(std::move(text), 0);
}

// The mesh that Pamgen holds for the process, one at a time.
class PamgenMesh {
 public:
  PamgenMesh(const std::string& text, int rank, int parts) {
    const long long code = Create_Pamgen_Mesh(text.c_str(), 3, rank, parts, INT_MAX);
    if (code == ERROR_FREE_CREATION) return;
    Delete_Pamgen_Mesh();
    throw Error(fmt::format("Pamgen makes no part {} of {} (code {})", rank + 1, parts, code));
  }
  ~PamgenMesh() { Delete_Pamgen_Mesh(); }
  PamgenMesh(const PamgenMesh&) = delete;
  PamgenMesh& operator=(const PamgenMesh&) = delete;

  // Fills `mesh`, which is empty.
  void take(InputMesh& mesh) {
    long long dimensions = 0, blocks = 0, node_sets = 0, side_sets = 0;
    std::string title(MAX_LINE_LENGTH + 1, '\0');
    good(
        im_ex_get_init_l(0, title.data(), &dimensions, &nodes_, &elements_, &blocks, &node_sets, &side_sets));
    long long all_nodes = 0, all_elements = 0, ignored[3];
    good(im_ne_get_init_global_l(0, &all_nodes, &all_elements, &ignored[0], &ignored[1], &ignored[2]));
    mesh.share.nodes = all_nodes;
    mesh.share.elements = all_elements;
    node_number_ = numbers(nodes_, im_ex_get_node_num_map_l);
    element_number_ = numbers(elements_, im_ex_get_elem_num_map_l);
    take_nodes(mesh.share);
    const Numbers block_ids = numbers(blocks, im_ex_get_elem_blk_ids_l);
    for (const long long id : block_ids) mesh.blocks.push_back({id, ""});
    take_elements(mesh.share, block_ids);
    for (const long long id : numbers(side_sets, im_ex_get_side_set_ids_l))
      mesh.side_sets.push_back(side_set(id));
    for (const long long id : numbers(node_sets, im_ex_get_node_set_ids_l))
      mesh.node_sets.push_back(node_set(id));
  }

 private:
  static void good(int code) { check(code >= 0, "Pamgen: data of a mesh"); }

  static Numbers numbers(long long count, int (*get)(int, long long*)) {
    Numbers list(static_cast<std::size_t>(count));
    if (!list.empty()) good(get(0, list.data()));
    return list;
  }
  [[nodiscard]] GlobalId node(long long local) const {
    return node_number_.at(static_cast<std::size_t>(local - 1)) - 1;
  }
  [[nodiscard]] GlobalId element(long long local) const {
    return element_number_.at(static_cast<std::size_t>(local - 1)) - 1;
  }
  // Places in a list of numbers, in ascending order of the numbers.
  static std::vector<std::size_t> ascending(const Numbers& list) {
    std::vector<std::size_t> order(list.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&list](std::size_t a, std::size_t b) { return list[a] < list[b]; });
    return order;
  }

  void take_nodes(ElementShare& share) const {
    const auto count = static_cast<std::size_t>(nodes_);
    std::vector<double> x(count), y(count), z(count);
    if (count > 0) good(im_ex_get_coord_l(0, x.data(), y.data(), z.data()));
    for (const std::size_t n : ascending(node_number_)) {
      share.node.push_back(node_number_[n] - 1);
      share.position.push_back({x[n], y[n], z[n]});
    }
  }

  void take_elements(ElementShare& share, const Numbers& block_ids) const {
    Numbers corners;
    std::vector<std::int32_t> block;
    for (std::size_t b = 0; b < block_ids.size(); ++b) {
      std::string type(MAX_STR_LENGTH + 1, '\0');
      long long count = 0, per_element = 0, attributes = 0;
      good(im_ex_get_elem_block_l(0, block_ids[b], type.data(), &count, &per_element, &attributes));
      if (count == 0) continue;
      check(per_element == 8, "Pamgen: elements have 8 nodes");
      const std::size_t known = corners.size();
      corners.resize(known + 8 * static_cast<std::size_t>(count));
      good(im_ex_get_elem_conn_l(0, block_ids[b], corners.data() + known));
      block.insert(block.end(), static_cast<std::size_t>(count), static_cast<std::int32_t>(b));
    }
    check(block.size() == element_number_.size(), "Pamgen: all elements are in blocks");
    for (const std::size_t e : ascending(element_number_)) {
      share.element.push_back(element_number_[e] - 1);
      share.block.push_back(block[e]);
      auto& corner = share.corner.emplace_back();
      for (std::size_t c = 0; c < 8; ++c) corner[c] = node(corners[8 * e + c]);
    }
  }

  [[nodiscard]] InputMesh::SideSet side_set(long long id) const {
    long long count = 0, factors = 0;
    good(im_ex_get_side_set_param_l(0, id, &count, &factors));
    Numbers elements(static_cast<std::size_t>(count)), sides(elements.size());
    if (count > 0) good(im_ex_get_side_set_l(0, id, elements.data(), sides.data()));
    InputMesh::SideSet set{id, "", {}, {}};
    for (const long long e : elements) set.element.push_back(element(e));
    for (const long long s : sides) set.face.push_back(static_cast<std::int32_t>(s - 1));
    return set;
  }

  [[nodiscard]] InputMesh::NodeSet node_set(long long id) const {
    long long count = 0, factors = 0;
    good(im_ex_get_node_set_param_l(0, id, &count, &factors));
    Numbers nodes(static_cast<std::size_t>(count));
    if (count > 0) good(im_ex_get_node_set_l(0, id, nodes.data()));
    InputMesh::NodeSet set{id, "", {}};
    for (const long long n : nodes) set.node.push_back(node(n));
    return set;
  }

  long long nodes_ = 0, elements_ = 0;
  Numbers node_number_, element_number_;
};

// Rank 0 tells the others: Pamgen gives sizes and ids to ranks that have a part only.
void share_header(const Comm& comm, InputMesh& mesh) {
  std::vector<std::int64_t> header;
  if (comm.rank() == 0) {
    header = {mesh.share.elements, mesh.share.nodes, std::ssize(mesh.blocks), std::ssize(mesh.side_sets)};
    for (const auto& b : mesh.blocks) header.push_back(b.id);
    for (const auto& s : mesh.side_sets) header.push_back(s.id);
    for (const auto& s : mesh.node_sets) header.push_back(s.id);
  }
  comm.broadcast(header, 0);
  if (!mesh.blocks.empty()) return;
  mesh.share.elements = header[0];
  mesh.share.nodes = header[1];
  const auto blocks = static_cast<std::size_t>(header[2]), side_sets = static_cast<std::size_t>(header[3]);
  for (std::size_t i = 4; i < header.size(); ++i) {
    if (i < 4 + blocks)
      mesh.blocks.push_back({header[i], ""});
    else if (i < 4 + blocks + side_sets)
      mesh.side_sets.push_back({header[i], "", {}, {}});
    else
      mesh.node_sets.push_back({header[i], "", {}});
  }
}

void print_summary(const Log& log, const std::string& path, const InputMesh& mesh) {
  log.line("Summary of imported pamgen hex mesh parameters");
  log.line("  File Name            {}", path);
  log.line("  Number of Elements   {}", mesh.share.elements);
  log.line("  Number of Nodes      {}", mesh.share.nodes);
  log.line("  Number of Blocks     {}", mesh.blocks.size());
  log.line("  Number of Side Sets  {}", mesh.side_sets.size());
  log.line("  Number of Node Sets  {}", mesh.node_sets.size());
}

}  // namespace

InputMesh read_pamgen(const Comm& comm, const std::string& path, const Log& log) {
  const std::string text = read_text(comm, path);
  std::vector<int> parts{0};
  collectively(comm, "trying " + path, [&] {
    if (comm.rank() != 0) return;
    const PamgenTrial trial = try_pamgen(path, text, comm.size());
    if (trial.parts == 0) throw Error(fmt::format("{}: '{}': {}", kOption, path, trial.problem));
    parts[0] = trial.parts;
  });
  comm.broadcast(parts, 0);
  InputMesh mesh;
  collectively(comm, "making the mesh of " + path, [&] {
    if (comm.rank() < parts[0]) PamgenMesh(text, comm.rank(), parts[0]).take(mesh);
  });
  share_header(comm, mesh);
  check_hexes(comm, mesh, path);
  print_summary(log, path, mesh);
  return mesh;
}

}  // namespace sculpt
