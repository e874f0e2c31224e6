#include "support/fields.hpp"

#include <algorithm>

#include "input/data_field.hpp"
#include "input/shape_fractions.hpp"
#include "sculpt/adapt/leaf_fractions.hpp"
#include "sculpt/adapt/leaf_mesh.hpp"
#include "sculpt/geom/sphere.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt::test {
namespace {

// Two materials, given how much of a box the second one fills.
class TwoMaterials final : public MaterialField {
 public:
  explicit TwoMaterials(std::function<double(const Box&)> second) : second_(std::move(second)) {}
  void measure(const Box& box, Fractions& out) override {
    const double s = second_(box);
    if (s < 1) out.add(0, 1 - s);
    if (s > 0) out.add(1, s);
    out.end_cell();
  }
  std::optional<std::int32_t> sole_material(const Box& box) override {
    const double s = second_(box);
    if (s > 0 && s < 1) return std::nullopt;
    return s > 0 ? 1 : 0;
  }

 private:
  std::function<double(const Box&)> second_;
};

}  // namespace

Grid unit_grid(const Index3& cells) { return uniform_grid(cells, {0, 0, 0}, {1, 1, 1}); }

std::unique_ptr<MaterialField> half_space_field(std::size_t axis, double at) {
  return std::make_unique<TwoMaterials>(
      [=](const Box& b) { return std::clamp((b.hi[axis] - at) / (b.hi[axis] - b.lo[axis]), 0.0, 1.0); });
}

std::unique_ptr<MaterialField> half_space_field(const Vec3& normal, double distance) {
  return std::make_unique<TwoMaterials>([=](const Box& b) {  // in the units of the box
    return part_above({0, 0, 0}, scaled(normal, b.hi - b.lo), distance - dot(normal, b.lo));
  });
}

std::unique_ptr<MaterialField> balls_field(const Grid& grid, const std::vector<Ball>& balls) {
  auto shapes = std::make_shared<std::vector<InsertedShape>>();
  for (const Ball& b : balls) shapes->push_back({std::make_unique<Sphere>(b.centre, b.radius), b.material});
  return shape_field(shapes, grid, 0);
}

ExactSurface balls_surface(std::vector<Ball> balls) {
  return [balls = std::move(balls)](const Vec3& p, std::int32_t, std::int32_t) -> std::optional<Vec3> {
    const auto off = [&p](const Ball& b) { return std::fabs(norm(p - b.centre) - b.radius); };
    const auto nearest = std::min_element(balls.begin(), balls.end(),
                                          [&](const Ball& a, const Ball& b) { return off(a) < off(b); });
    return Sphere(nearest->centre, nearest->radius).nearest_on_surface(p);
  };
}

std::unique_ptr<MaterialField> data_field_of(const Case& input) {
  return data_field(input.grid, whole(input.grid.cells), fractions_in(input, whole(input.grid.cells)));
}

BlockParts alone(const Forest& forest) {
  const Index3 n = forest.blocks(0);
  return {n, {whole(n)}, std::vector<std::int32_t>(static_cast<std::size_t>(whole(n).size()), 0)};
}

Forest marked(const Grid& grid, int levels, MaterialField& field, const AdaptCriterion& criterion) {
  Forest forest(grid.cells, levels, kNotPeriodic);
  mark_cells(grid, whole(grid.cells), field, criterion, forest);
  forest.close();
  return forest;
}

Forest random_forest(const Index3& cells, int levels, double share, std::uint64_t seed) {
  Forest forest(cells, levels, kNotPeriodic);
  const IndexBox box = whole(forest.cells(levels - 1));
  for (std::int64_t c = 0; c < box.size(); ++c)
    if (scatter_unit(seed, static_cast<std::uint64_t>(c)) < share)
      forest.refine_cell(levels - 1, box.cell(c));
  forest.close();
  return forest;
}

Overlay refined_overlay(const Comm& comm, const Grid& grid, const Forest& forest, const BlockParts& parts,
                        MaterialField& field, int layers) {
  LeafMesh mesh = leaf_mesh(comm, grid, forest, parts, layers);
  const Fractions owned = leaf_fractions(grid, mesh, field);
  Overlay o{std::move(mesh.cells), {}};
  o.fractions = with_ghosts(o.cells, owned);
  assign_materials(o.cells, o.fractions, face_neighbours(o.cells));
  return o;
}

}  // namespace sculpt::test
