#include "pebble.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "sculpt/facets/facet_mesh.hpp"

namespace microstructure {
namespace {

TEST(Pebble, IsClosedAndHollow) {
  const auto path = std::filesystem::temp_directory_path() / ("pebble" + std::to_string(::getpid()));
  write_pebble(path.string(), {3, 5});
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  sculpt::FacetMesh mesh = sculpt::parse_stl(text, "pebble.stl");
  EXPECT_EQ(mesh.triangles.size(), 1024U);
  const sculpt::FacetReport report = sculpt::repair(mesh);
  EXPECT_EQ(report.open.count + report.non_manifold.count + report.flipped.count, 0);
  EXPECT_EQ(report.components, 2);
  const double ball = 4.0 / 3.0 * std::numbers::pi, volume = sculpt::sizes_of(mesh).volume;
  EXPECT_GT(volume, 0.8 * ball);
  EXPECT_LT(volume, 3 * ball);
}

}  // namespace
}  // namespace microstructure
