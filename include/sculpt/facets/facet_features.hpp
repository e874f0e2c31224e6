#pragma once
// The smooth surfaces, sharp curves and corners of faceted solids, for meshes that are tied to them.
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sculpt/facets/facet_mesh.hpp"
#include "sculpt/geom/features.hpp"

namespace sculpt {

class FacetTree;

class FacetFeatures final : public GeometryFeatures {
 public:
  struct Solid {
    const FacetMesh* mesh;  // repaired; FacetMesh::surface and corner are filled
    std::int32_t material;  // dense index
  };
  // Surfaces and corners are numbered through all solids. Nothing that is farther than `reach` (a length) is
  // found.
  FacetFeatures(const std::vector<Solid>& solids, double reach);
  ~FacetFeatures() override;

  [[nodiscard]] std::int32_t surfaces() const override { return surfaces_; }
  [[nodiscard]] std::optional<SurfacePoint> nearest(const Vec3& p, std::int32_t a,
                                                    std::int32_t b) const override;
  [[nodiscard]] std::optional<Vec3> on_surface(std::int32_t surface, const Vec3& p) const override;
  [[nodiscard]] std::optional<Vec3> on_curve(std::int32_t a, std::int32_t b, const Vec3& p) const override;
  [[nodiscard]] std::optional<Corner> at_corner(std::span<const std::int32_t> surfaces,
                                                const Vec3& p) const override;

 private:
  struct Segment {
    Vec3 a, b;
  };
  struct SolidCorner {
    std::int32_t number;
    Vec3 point;
    std::vector<std::int32_t> surfaces;  // that meet there, ascending
  };
  void add(const Solid& solid, std::int32_t first_surface, std::int32_t first_corner);

  double reach_;
  std::int32_t surfaces_ = 0;
  std::vector<std::int32_t> surface_, material_;  // per facet of the tree
  std::unique_ptr<const FacetTree> tree_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Segment>> curves_;  // by their two surfaces
  std::vector<SolidCorner> corners_;
};

}  // namespace sculpt
