#include "sculpt/distribute/repartition.hpp"

#include <algorithm>
#include <numeric>

#include "distribute/faces.hpp"
#include "distribute/id_index.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/mesh/node_directory.hpp"

namespace sculpt {
namespace {

std::vector<Vec3> centres(const Comm& comm, const ElementShare& share, const IdIndex& nodes) {
  const std::vector<Vec3> position = positions_of(comm, share, nodes.ids());
  std::vector<Vec3> centre;
  centre.reserve(share.corner.size());
  for (const auto& corner : share.corner) {
    Vec3 sum;
    for (const GlobalId node : corner) sum += position[at(nodes.index(node))];
    centre.push_back(0.125 * sum);
  }
  return centre;
}

// The elements across the faces of each element.
class DualGraph {
 public:
  DualGraph(const Comm& comm, const ElementShare& share, const IdIndex& nodes) : share_(share) {
    const EvenParts ranges{share.nodes, comm.size()};
    std::vector<std::vector<Open>> open(static_cast<std::size_t>(comm.size()));
    for_each_face(share, nodes, [&](std::span<const LocalFace> faces) {
      if (faces.size() == 1)
        open[ranges.part_of(faces[0].key[0])].push_back({faces[0].key, element(faces[0])});
      for (std::size_t i = 1; i < faces.size(); ++i) {
        add(element(faces[0]), element(faces[i]), comm.rank());
        add(element(faces[i]), element(faces[0]), comm.rank());
      }
    });
    // What no face on the same rank answers meets at the rank that keeps its smallest node.
    const auto arrived = comm.all_to_all(open);
    std::vector<Met> met;
    for (std::size_t r = 0; r < arrived.size(); ++r)
      for (const Open& face : arrived[r]) met.push_back({face, static_cast<std::int32_t>(r)});
    std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) {
      return std::pair(a.face.key, a.face.element) < std::pair(b.face.key, b.face.element);
    });
    std::vector<std::vector<Link>> links(static_cast<std::size_t>(comm.size()));
    for (std::size_t i = 1; i < met.size(); ++i) {
      const Met &a = met[i - 1], &b = met[i];
      if (a.face.key != b.face.key || a.face.element == b.face.element) continue;
      links[static_cast<std::size_t>(a.rank)].push_back({a.face.element, b.face.element, b.rank});
      links[static_cast<std::size_t>(b.rank)].push_back({b.face.element, a.face.element, a.rank});
    }
    for (const auto& from : comm.all_to_all(links)) links_.insert(links_.end(), from.begin(), from.end());
    finish();
  }

  [[nodiscard]] const std::vector<std::int64_t>& first() const { return first_; }
  [[nodiscard]] const std::vector<GlobalId>& neighbour() const { return neighbour_; }
  [[nodiscard]] const std::vector<std::int32_t>& rank() const { return rank_; }

 private:
  struct Open {
    FaceNodes key;
    GlobalId element;
  };
  struct Met {
    Open face;
    std::int32_t rank;
  };
  struct Link {
    GlobalId element, neighbour;
    std::int32_t rank;
  };

  [[nodiscard]] GlobalId element(const LocalFace& face) const { return share_.element[face.element()]; }
  void add(GlobalId from, GlobalId to, std::int32_t rank) {
    if (from != to) links_.push_back({from, to, rank});
  }

  // Two elements that share several faces are neighbours once.
  void finish() {
    const auto order = [](const Link& l) { return std::pair(l.element, l.neighbour); };
    std::sort(links_.begin(), links_.end(),
              [&](const Link& a, const Link& b) { return order(a) < order(b); });
    links_.erase(std::unique(links_.begin(), links_.end(),
                             [&](const Link& a, const Link& b) { return order(a) == order(b); }),
                 links_.end());
    first_.push_back(0);
    std::size_t next = 0;
    for (const GlobalId e : share_.element) {
      for (; next < links_.size() && links_[next].element == e; ++next) {
        neighbour_.push_back(links_[next].neighbour);
        rank_.push_back(links_[next].rank);
      }
      first_.push_back(static_cast<std::int64_t>(next));
    }
    links_ = {};
  }

  const ElementShare& share_;
  std::vector<Link> links_;
  std::vector<std::int64_t> first_;
  std::vector<GlobalId> neighbour_;
  std::vector<std::int32_t> rank_;
};

// The pieces that came from the ranks, in the order of their elements.
template <class T>
std::vector<T> reordered(const Comm& comm, const std::vector<std::vector<T>>& out,
                         const std::vector<std::size_t>& order, std::size_t per_element = 1) {
  std::vector<T> arrived, result;
  for (const auto& from : comm.all_to_all(out)) arrived.insert(arrived.end(), from.begin(), from.end());
  result.reserve(arrived.size());
  for (const std::size_t e : order)
    for (std::size_t i = 0; i < per_element; ++i) result.push_back(arrived[e * per_element + i]);
  return result;
}

}  // namespace

void move_elements(const Comm& comm, ElementShare& share, std::span<const std::int32_t> to) {
  if (comm.size() == 1) return;
  const auto values = static_cast<std::size_t>(share.values_per_element);
  // One array at a time, so that little is in memory twice.
  const auto packed = [&]<class T>(std::vector<T>& items, std::size_t per_element) {
    std::vector<std::vector<T>> out(static_cast<std::size_t>(comm.size()));
    for (std::size_t e = 0; e < to.size(); ++e)
      for (std::size_t i = 0; i < per_element; ++i)
        out[static_cast<std::size_t>(to[e])].push_back(items[e * per_element + i]);
    items = {};
    return out;
  };
  std::vector<GlobalId> element;
  for (const auto& from : comm.all_to_all(packed(share.element, 1)))
    element.insert(element.end(), from.begin(), from.end());
  std::vector<std::size_t> order(element.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return element[a] < element[b]; });
  for (const std::size_t e : order) share.element.push_back(element[e]);
  share.corner = reordered(comm, packed(share.corner, 1), order);
  share.block = reordered(comm, packed(share.block, 1), order);
  share.value = reordered(comm, packed(share.value, values), order, values);
}

void repartition(const Comm& comm, ElementShare& share, PartitionMethod method) {
  if (comm.size() == 1) return;
  std::vector<std::int32_t> to;
  {
    const IdIndex nodes(share.corner);
    const std::vector<Vec3> centre = centres(comm, share, nodes);
    if (method == PartitionMethod::kGraph) {
      const DualGraph graph(comm, share, nodes);
      to = partition(comm, method, {share.element, centre, graph.first(), graph.neighbour(), graph.rank()});
    } else {
      to = partition(comm, method, {share.element, centre, {}, {}, {}});
    }
  }
  move_elements(comm, share, to);
}

}  // namespace sculpt
