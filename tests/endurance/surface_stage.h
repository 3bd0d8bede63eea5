#pragma once
// A restricted power diagram with either neighbour source.

#include "geom/indexed_heap.h"
#include "geom/restricted_power.h"
#include "tests/endurance/stage.h"

namespace geom {
class SiteTree;
}

namespace endurance {

class SurfaceStage final : public Stage {
 public:
  SurfaceStage(const Place& place, bool search);

  bool farthest(bool of_last_change, geom::Vec3& out) const override;
  geom::Vec3 anywhere(bool special, geom::Rng& rng) const override;
  double area() const override { return mesh_->area(); }
  void check() const override;
  void check_by_brute_force(geom::Rng& rng) const override;
  std::unique_ptr<Stage> rebuilt() const override;
  void compare(const Stage& other) const override;

 private:
  using Mesh = std::shared_ptr<const geom::TriMesh>;
  struct CircleOrder {
    const geom::RestrictedPower* diagram;
    bool operator()(geom::CircleId a, geom::CircleId b) const { return diagram->circle_before(a, b); }
  };

  SurfaceStage(const Place& place, bool search, Mesh mesh);
  bool insert(geom::SiteId s, const geom::WeightedPoint3& point) override;
  bool remove(geom::SiteId s) override;
  geom::SiteId some_other() const;
  bool put_back_and_move(geom::SiteId s, const geom::WeightedPoint3& point);
  void apply_change(const geom::RestrictedPower::Change& change);
  std::vector<geom::EmptyCircle> circles() const;
  void check_facet(geom::FacetId t) const;

  Place place_;
  bool search_;
  Mesh mesh_;
  std::unique_ptr<geom::NeighbourSource> source_;
  std::unique_ptr<geom::RestrictedPower> diagram_;
  geom::IndexedHeap<geom::CircleId, CircleOrder> heap_;
  std::vector<geom::CircleId> last_created_;
  std::size_t most_circles_ = 0;  ///< ids are below
  geom::SiteId removed_;          ///< the last one
  geom::WeightedPoint3 removed_point_{geom::Vec3(0, 0, 0), 0};
};

}  // namespace endurance
