#pragma once
// Neighbours from the dynamic regular triangulation in space: the paper's way (section 4.2 on CGAL, here on
// regular3.h).
//
// The cells of a restricted power diagram are parts of the cells of the diagram in space. What p takes on
// insertion it takes from its neighbours there, and what it leaves on removal goes to them, or to sites that
// it had hidden.

#include "geom/regular/regular3.h"
#include "geom/sites/neighbour_oracle.h"

namespace geom {

class TriangulationOracle final : public NeighbourOracle {
 public:
  /// All sites must lie in the box.
  explicit TriangulationOracle(const Box3& box) : triangulation_(box) {}

  void insert(SiteId id, const WeightedPoint3& point, SiteId hint) override;
  void remove(SiteId id) override;
  void rivals(SiteId p, std::vector<SiteId>& out) const override;
  void heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const override;
  void set_reach(SiteId, double) override {}
  /// A walk over edges from the hint; O(1) expected if that is near, O(n) without one.
  Nearest nearest(const Location3& location, SiteId without, SiteId hint) const override;

  const Regular3& triangulation() const { return triangulation_; }

 private:
  Nearest nearest_of_all(const Vec3& x, SiteId without) const;
  void offer(const Vec3& x, SiteId s, SiteId without, Nearest& best) const;

  Regular3 triangulation_;
  std::vector<SiteId> present_;        ///< in no order
  Table<SiteId, std::int32_t> place_;  ///< in present_
  std::vector<SiteId> last_hidden_;    ///< by the last insertion
  std::vector<SiteId> last_heirs_;     ///< of the last removal
};

}  // namespace geom
