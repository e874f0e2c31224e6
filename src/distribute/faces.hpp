#pragma once
// Faces of the hexes of an ElementShare that have the same four nodes.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "distribute/id_index.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/mesh/element_share.hpp"

namespace sculpt {

using FaceNodes = std::array<GlobalId, 4>;

[[nodiscard]] inline FaceNodes sorted(FaceNodes nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}
// Of face f of the hex with these corners, outward.
[[nodiscard]] inline FaceNodes face_nodes(const std::array<GlobalId, 8>& corner, std::size_t f) {
  FaceNodes nodes;
  for (std::size_t v = 0; v < 4; ++v) nodes[v] = corner[static_cast<std::size_t>(kFaces[f][v])];
  return nodes;
}

// A face as 8 * local element + face (kFaces index).
struct LocalFace {
  FaceNodes key;  // sorted
  std::int64_t code;
  [[nodiscard]] std::size_t element() const { return static_cast<std::size_t>(code / 8); }
  [[nodiscard]] std::size_t face() const { return static_cast<std::size_t>(code % 8); }
};

// Local. Calls visit(span of LocalFace) for every set of faces of these elements with the same four nodes;
// nodes: those of the corners.
template <class Visit>
void for_each_face(const ElementShare& share, const IdIndex& nodes, const Visit& visit) {
  std::vector<std::int64_t> first(nodes.ids().size() + 1, 0);  // of the faces with the smallest node so
  const auto least = [&](std::size_t e, std::size_t f) {
    const FaceNodes face = face_nodes(share.corner[e], f);
    return at(nodes.index(*std::min_element(face.begin(), face.end())));
  };
  for (std::size_t e = 0; e < share.corner.size(); ++e)
    for (std::size_t f = 0; f < 6; ++f) ++first[least(e, f) + 1];
  for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
  std::vector<std::int32_t> codes(6 * share.corner.size());
  for (std::size_t e = 0; e < share.corner.size(); ++e)
    for (std::size_t f = 0; f < 6; ++f)
      codes[static_cast<std::size_t>(first[least(e, f)]++)] = static_cast<std::int32_t>(8 * e + f);
  std::vector<LocalFace> faces;
  std::size_t begin = 0;
  for (std::size_t n = 0; n + 1 < first.size(); ++n) {
    const auto end = static_cast<std::size_t>(first[n]);
    faces.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const auto code = static_cast<std::size_t>(codes[i]);
      faces.push_back({sorted(face_nodes(share.corner[code / 8], code % 8)), codes[i]});
    }
    begin = end;
    std::stable_sort(faces.begin(), faces.end(),
                     [](const LocalFace& a, const LocalFace& b) { return a.key < b.key; });
    for (std::size_t i = 0; i < faces.size();) {
      std::size_t j = i + 1;
      while (j < faces.size() && faces[j].key == faces[i].key) ++j;
      visit(std::span<const LocalFace>(faces.data() + i, j - i));
      i = j;
    }
  }
}

}  // namespace sculpt
