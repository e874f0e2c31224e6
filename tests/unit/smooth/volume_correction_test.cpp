#include "sculpt/smooth/volume_correction.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "sculpt/mesh/adjacency.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

std::vector<double> volumes(const HexMesh& mesh, std::size_t materials) {
  std::vector<double> v(materials, 0);
  for (LocalId h = 0; h < mesh.size(); ++h) v[at(mesh.material[at(h)])] += hex_volume(mesh.corners(h));
  return v;
}
std::vector<LocalId> interface_nodes(const HexMesh& mesh) {
  const NodeHexes around(mesh);
  std::vector<LocalId> index(mesh.position.size(), kNone);
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    for (const std::int32_t item : around[n])
      if (mesh.material[at(item / 8)] != mesh.material[at(around[n][0] / 8)]) index[at(n)] = 0;
  return index;
}
double worst(const HexMesh& mesh) {
  double q = 1;
  for (LocalId h = 0; h < mesh.size(); ++h) q = std::min(q, scaled_jacobian(mesh.corners(h)));
  return q;
}

TEST(CorrectVolumes, GivesSeveralMaterialsTheirVolumes) {
  test::StagesResult r = test::run_stages(Comm::self(), test::grains({12, 11, 10}, 9, 5, 3));
  const std::vector<double> before = volumes(r.mesh, 5);
  const double floor = std::min(worst(r.mesh), 0.3);
  const std::vector<double> wanted{before[0] * 1.01, -1, before[2] * 0.99, before[3], -1};
  const VolumeCorrection done = correct_volumes(r.mesh, interface_nodes(r.mesh), wanted, 0.3);
  const std::vector<double> after = volumes(r.mesh, 5);
  for (const std::size_t m : {0, 2, 3}) EXPECT_NEAR(after[m], wanted[m], 1e-3 * wanted[m]) << m;
  EXPECT_NEAR(std::accumulate(after.begin(), after.end(), 0.0), 12 * 11 * 10, 1e-9);
  EXPECT_GE(worst(r.mesh), floor);
  EXPECT_LT(done.error, 1e-3);
  EXPECT_GT(done.farthest, 0);
  EXPECT_LT(done.farthest, 0.3);
}

TEST(CorrectVolumes, MovesNothingWhereTheVolumesAreRight) {
  test::StagesResult r = test::run_stages(Comm::self(), test::grains({9, 9, 9}, 5, 3, 4));
  const std::vector<Vec3> before = r.mesh.position;
  const VolumeCorrection done = correct_volumes(r.mesh, interface_nodes(r.mesh), volumes(r.mesh, 3), 0.3);
  EXPECT_EQ(r.mesh.position, before);
  EXPECT_EQ(done.rounds, 0);
}

TEST(CorrectVolumes, LeavesAloneWhatIsTooFarOff) {
  test::StagesResult r = test::run_stages(Comm::self(), test::grains({12, 11, 10}, 9, 3, 3));
  const std::vector<double> before = volumes(r.mesh, 3);
  const std::vector<double> wanted{before[0] * 1.01, before[1] * 1.05, -1};
  const VolumeCorrection done = correct_volumes(r.mesh, interface_nodes(r.mesh), wanted, 0.3, 0.02);
  const std::vector<double> after = volumes(r.mesh, 3);
  EXPECT_NEAR(after[0], wanted[0], 1e-4 * wanted[0]);
  EXPECT_LT(after[1], before[1] * 1.01);
  EXPECT_LT(done.error, 1e-4) << "of those that are corrected";
  EXPECT_EQ(done.left_alone, 1);
}

TEST(CorrectVolumes, DoesNotBuyVolumeWithQuality) {
  test::StagesResult r = test::run_stages(Comm::self(), test::ball({10, 10, 10}, {5, 5, 5}, 2.2));
  const std::vector<double> before = volumes(r.mesh, 2);
  const double floor = std::min(worst(r.mesh), 0.3);
  const VolumeCorrection done =
      correct_volumes(r.mesh, interface_nodes(r.mesh), std::vector<double>{-1, 3 * before[1]}, 0.3);
  EXPECT_GE(worst(r.mesh), floor);
  EXPECT_GT(done.error, 0.1) << "three times the volume is out of reach, and that is told";
}

}  // namespace
}  // namespace sculpt
