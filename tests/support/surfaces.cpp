#include "support/surfaces.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace sculpt::test {

Facets box_facets(const Vec3& lo, const Vec3& hi) {
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto corner = [&](int c) {
    return Vec3{c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z};
  };
  Facets facets;
  for (const auto& s : kSides) {
    facets.push_back({corner(s[0]), corner(s[1]), corner(s[2])});
    facets.push_back({corner(s[0]), corner(s[2]), corner(s[3])});
  }
  return facets;
}

Facets ball_facets(int slices, const std::function<double(const Vec3&)>& radius) {
  const int stacks = slices / 2;
  const auto point = [&](int i, int j) {
    const double theta = std::numbers::pi * i / stacks, phi = 2 * std::numbers::pi * (j % slices) / slices;
    const double ring = i == 0 || i == stacks ? 0.0 : std::sin(theta);
    const Vec3 way{ring * std::cos(phi), ring * std::sin(phi), std::cos(theta)};
    return radius(way) * way;
  };
  Facets facets;
  for (int i = 0; i < stacks; ++i)
    for (int j = 0; j < slices; ++j) {
      const Vec3 a = point(i, j), b = point(i, j + 1), c = point(i + 1, j), d = point(i + 1, j + 1);
      if (i + 1 < stacks) facets.push_back({a, c, d});
      if (i > 0) facets.push_back({a, d, b});
    }
  return facets;
}

Facets turned(Facets facets) {
  for (auto& f : facets) std::swap(f[1], f[2]);
  return facets;
}

Facets moved(Facets facets, const Vec3& by) {
  for (auto& f : facets)
    for (Vec3& p : f) p += by;
  return facets;
}

Facets operator+(Facets a, const Facets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string binary_stl(const Facets& facets, const std::string& header) {
  std::string text = header;
  text.resize(80, ' ');
  const auto put = [&](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(facets.size()));
  for (const auto& f : facets) {
    for (int d = 0; d < 3; ++d) put(0.0F);
    for (const Vec3& p : f)
      for (std::size_t d = 0; d < 3; ++d) put(static_cast<float>(p[d]));
    put(std::uint16_t{0});
  }
  return text;
}

std::string ascii_stl(const Facets& facets, const std::string& name) {
  std::string text = "solid " + name + "\n";
  for (const auto& f : facets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& p : f) text += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

FacetMesh mesh_of(const Facets& facets) {
  FacetMesh mesh = parse_stl(ascii_stl(facets), "test.stl");
  (void)repair(mesh);
  return mesh;
}

double winding_by_angles(const Facets& facets, const Vec3& p) {
  double sum = 0;
  for (const auto& f : facets) {
    const Vec3 a = f[0] - p, b = f[1] - p, c = f[2] - p;
    sum += std::atan2(dot(a, cross(b, c)), norm(a) * norm(b) * norm(c) + dot(a, b) * norm(c) +
                                               dot(b, c) * norm(a) + dot(c, a) * norm(b));
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace sculpt::test
