// The whole restricted power diagram at once: facets are divided each by itself (facet_cells.h), by several
// threads, and their fragments entered one after the other, both along a space-filling curve: what is near in space
// is found and stored together.

#include <algorithm>

#include "geom/check.h"
#include "geom/divided_surface.h"
#include "geom/restricted_power.h"

namespace geom {

const RestrictedPower::Change& RestrictedPower::build(std::span<const WeightedPoint3> points,
                                                      const NeighbourSource& search, int threads) {
  ensure(sites_.empty() && !points.empty(), "restricted power diagram: built once, of some sites");
  begin(SiteId(points.size() - 1));
  sites_.reserve(points.size());
  for (const WeightedPoint3& point : points) admit(sites_.next_id(), point);
  const DividedSurface surface{mesh_, sites_, clipper_, search};
  surface.for_each(facets_along_curve(mesh_), threads, [&](FacetId t, std::span<const FacetPiece> pieces) {
    for (const auto& [owner, corners] : pieces) {
      polygon_.facet = t;
      polygon_.owner = owner;
      polygon_.corners.assign(corners.begin(), corners.end());
      touch_cell(owner);
      reach_[owner] = std::max(reach_[owner], commit(FragmentId(), polygon_));
    }
  });
  std::vector<Change::Piece>().swap(change_.created);
  finish();
  return change_;
}

}  // namespace geom
