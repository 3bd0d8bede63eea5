#pragma once
// A restricted dual with either neighbour source.

#include "geom/dual/restricted_dual.h"
#include "geom/indexed_heap.h"
#include "geom/mesh/aabb_tree.h"
#include "tests/endurance/stage.h"

namespace endurance {

class SurfaceStage final : public Stage {
 public:
  SurfaceStage(const Place& place, bool search);

  bool farthest(bool of_last_change, geom::Vec3& out) const override;
  geom::Vec3 anywhere(bool special, geom::Rng& rng) const override;
  double area() const override { return surface_->mesh.area(); }
  void check() const override;
  void check_by_brute_force(geom::Rng& rng) const override;
  std::unique_ptr<Stage> rebuilt() const override;
  void compare(const Stage& other) const override;

 private:
  struct Surface {
    explicit Surface(geom::TriMesh surface) : mesh(std::move(surface)), tree(mesh) {}
    geom::TriMesh mesh;
    geom::AabbTree tree;
  };
  struct CircleOrder {
    const geom::RestrictedDual* dual;
    bool operator()(geom::CircleId a, geom::CircleId b) const {
      return circle_before(dual->circle(a), dual->circle(b));
    }
  };

  SurfaceStage(const Place& place, bool search, std::shared_ptr<const Surface> surface);
  bool insert(geom::SiteId s, const geom::WeightedPoint3& point) override;
  bool remove(geom::SiteId s) override;
  geom::CornerTypes types() const;
  geom::FacetId home_of(geom::SiteId s, const geom::WeightedPoint3& point) const;
  geom::CircleId circle_at(const geom::Vec3& center, geom::SiteId not_of) const;
  void put_back_and_move(geom::SiteId s, const geom::WeightedPoint3& point);
  void apply_change(const geom::RestrictedDual::Change& change);
  geom::Clipper::Sites sites() const;
  void check_facet(geom::FacetId t) const;
  void check_cell(geom::SiteId p) const;
  void compare_with_built() const;

  Place place_;
  bool search_;
  std::shared_ptr<const Surface> surface_;
  std::unique_ptr<geom::NeighbourOracle> paper_;
  std::unique_ptr<geom::RestrictedDual> dual_;
  geom::IndexedHeap<geom::CircleId, CircleOrder> heap_;
  std::vector<geom::CircleId> last_created_;
  std::size_t most_circles_ = 0;  ///< ids are below
  geom::SiteId removed_;          ///< the last one
  geom::WeightedPoint3 removed_point_{geom::Vec3(0, 0, 0), 0};
};

}  // namespace endurance
