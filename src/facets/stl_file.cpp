#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "facets/vertex_index.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/facets/facet_mesh.hpp"

namespace sculpt {
namespace {

constexpr std::size_t kHeader = 84, kRecord = 50;  // bytes of a binary file: header and count, facet
constexpr std::size_t kNormal = 12, kVertex = 12;  // bytes of a vector in a record
constexpr std::int64_t kMostFacets = std::numeric_limits<LocalId>::max() / 3;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

void refuse_too_many(std::int64_t facets, const std::string& path) {
  if (facets > kMostFacets)
    throw Error(fmt::format("{}: found {} facets, expected at most {}", path, facets, kMostFacets));
}

class BinaryReader {
 public:
  BinaryReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  FacetMesh read() {
    const std::int64_t facets = count(text_);
    refuse_too_many(facets, path_);
    FacetMesh mesh;
    VertexIndex index(mesh.vertices);
    mesh.triangles.reserve(static_cast<std::size_t>(facets));
    mesh.vertices.reserve(static_cast<std::size_t>(facets) / 2 + 2);
    for (std::int64_t f = 0; f < facets; ++f) {
      std::array<LocalId, 3> triangle{};
      const char* at = text_.data() + kHeader + kRecord * static_cast<std::size_t>(f) + kNormal;
      for (LocalId& corner : triangle) {
        corner = index.find_or_add(vertex(at, f));
        at += kVertex;
      }
      mesh.triangles.push_back(triangle);
      mesh.facet.push_back(f + 1);
    }
    mesh.part.assign(mesh.triangles.size(), 0);
    mesh.part_names.emplace_back();
    return mesh;
  }

  // The facets that the header promises.
  static std::int64_t count(std::string_view text) {
    std::uint32_t facets = 0;
    std::memcpy(&facets, text.data() + kHeader - sizeof facets, sizeof facets);
    return facets;
  }
  static bool has_its_size(std::string_view text) {
    return text.size() >= kHeader && text.size() == kHeader + kRecord * static_cast<std::size_t>(count(text));
  }

 private:
  [[nodiscard]] Vec3 vertex(const char* at, std::int64_t facet) const {
    static_assert(std::endian::native == std::endian::little);
    std::array<float, 3> x{};
    std::memcpy(x.data(), at, sizeof x);
    for (const float c : x)
      if (!std::isfinite(c))
        throw Error(fmt::format("{}, facet {}: found a coordinate {}, expected a finite number", path_,
                                facet + 1, c));
    return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
  }

  std::string_view text_;
  const std::string& path_;
};

class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& path)
      : at_(text.data()), begin_(text.data()), end_(text.data() + text.size()), path_(path) {}

  FacetMesh read() {
    FacetMesh mesh;
    VertexIndex index(mesh.vertices);
    while (true) {
      std::string_view word = next();
      if (word.empty()) break;
      if (!same(word, "solid")) fail(word, "'solid'");
      mesh.part_names.emplace_back(rest_of_line());
      read_solid(mesh, index);
    }
    return mesh;
  }

 private:
  void read_solid(FacetMesh& mesh, VertexIndex& index) {
    while (true) {
      const std::string_view word = next();
      if (same(word, "endsolid")) break;
      if (!same(word, "facet")) fail(word, "'facet' or 'endsolid'");
      take("normal");
      for (int d = 0; d < 3; ++d) next();  // of no use, and sometimes no number
      take("outer");
      take("loop");
      std::array<LocalId, 3> triangle{};
      for (LocalId& corner : triangle) {
        take("vertex");
        Vec3 p;
        for (std::size_t d = 0; d < 3; ++d) p[d] = number();
        corner = index.find_or_add(p);
      }
      take("endloop");
      take("endfacet");
      mesh.triangles.push_back(triangle);
      mesh.facet.push_back(static_cast<std::int64_t>(mesh.facet.size()) + 1);
      mesh.part.push_back(static_cast<std::int32_t>(mesh.part_names.size()) - 1);
      refuse_too_many(mesh.facet.back(), path_);
    }
    rest_of_line();
  }

  // The next word; empty at the end of the text.
  std::string_view next() {
    while (at_ != end_ && is_space(*at_)) ++at_;
    const char* const start = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
  }
  std::string_view rest_of_line() {
    while (at_ != end_ && *at_ != '\n' && is_space(*at_)) ++at_;
    const char* const start = at_;
    at_ = std::find(at_, end_, '\n');
    const char* last = at_;
    while (last != start && is_space(last[-1])) --last;
    return {start, static_cast<std::size_t>(last - start)};
  }
  void take(std::string_view expected) {
    const std::string_view word = next();
    if (!same(word, expected)) fail(word, fmt::format("'{}'", expected));
  }
  double number() {
    const std::string_view word = next();
    const char* const first = word.data() + (!word.empty() && word[0] == '+' ? 1 : 0);
    const char* const last = word.data() + word.size();
    double value = 0;
    const auto [after, error] = std::from_chars(first, last, value);
    const bool is_tiny = error == std::errc::result_out_of_range && std::fabs(value) < 1;
    if (word.empty() || after != last || (error != std::errc() && !is_tiny) || !std::isfinite(value))
      fail(word, "three finite coordinates of a vertex");
    return value;
  }
  static bool same(std::string_view word, std::string_view lower) {
    return word.size() == lower.size() &&
           std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
             return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
           });
  }
  // `word` is the last one that was read.
  [[noreturn]] void fail(std::string_view word, const std::string& expected) const {
    constexpr std::size_t kShown = 40;
    const auto line = 1 + std::count(begin_, word.data(), '\n');
    std::string found = "the end of the file";
    if (!word.empty()) {
      found = "'";
      for (const char c : word.substr(0, kShown)) found += c >= ' ' && c <= '~' ? c : '?';
      found += word.size() > kShown ? "...'" : "'";
    }
    throw Error(fmt::format("{}, line {}: found {}, expected {}", path_, line, found, expected));
  }

  const char* at_;
  const char* begin_;
  const char* end_;
  const std::string& path_;
};

// What begins like an ASCII file and holds no byte that text does not have.
bool looks_like_ascii(std::string_view text) {
  const std::size_t start =
      static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_space) - text.begin());
  std::string word(text.substr(start, 5));
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return word == "solid" && text.substr(0, 1024).find('\0') == std::string_view::npos;
}

}  // namespace

FacetMesh parse_stl(std::string_view text, const std::string& path) {
  if (BinaryReader::has_its_size(text)) return BinaryReader(text, path).read();
  if (looks_like_ascii(text)) return AsciiReader(text, path).read();
  if (text.size() < kHeader)
    throw Error(fmt::format("{}: found {} bytes that do not begin with 'solid', expected an STL file", path,
                            text.size()));
  const std::int64_t facets = BinaryReader::count(text);
  throw Error(
      fmt::format("{}: found {} bytes; a binary STL file of {} facets, as its header says, has {} bytes, and "
                  "an ASCII one "
                  "begins with 'solid': it is cut off, damaged or no STL file",
                  path, text.size(), facets, kHeader + kRecord * static_cast<std::size_t>(facets)));
}

}  // namespace sculpt
