#pragma once
// A regular triangulation of the flat torus. A lattice of anchors, which stay, leaves no gap of half a
// period.

#include "geom/regular/regular2.h"
#include "tests/endurance/stage.h"

namespace endurance {

class PlaneStage final : public Stage {
 public:
  explicit PlaneStage(const Place& place);

  bool farthest(bool of_last_change, geom::Vec3& out) const override;
  geom::Vec3 anywhere(bool special, geom::Rng& rng) const override;
  double area() const override { return place_.period.prod(); }
  void check() const override { triangulation_.check(); }
  void check_by_brute_force(geom::Rng& rng) const override;
  std::unique_ptr<Stage> rebuilt() const override;
  void compare(const Stage& other) const override;

 private:
  struct Keyed {
    geom::Regular2::Triangle corners;
    double radius2;
    auto operator<=>(const Keyed&) const = default;
  };

  bool insert(geom::SiteId s, const geom::WeightedPoint3& point) override;
  bool remove(geom::SiteId s) override;
  void note(const geom::Regular2::Change& change);
  void check_nearest(geom::SiteId id) const;
  void check_empty(geom::SimplexId t) const;
  std::vector<geom::SiteId> all_sites() const;
  std::vector<Keyed> triangles() const;

  Place place_;
  geom::Regular2 triangulation_;
  std::vector<geom::SimplexId> last_created_;
};

}  // namespace endurance
