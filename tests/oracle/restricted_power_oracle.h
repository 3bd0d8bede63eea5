#pragma once
// The restricted power diagram, slow and obvious.

#include <algorithm>
#include <vector>

#include "geom/power/restricted_power.h"

namespace oracle {

/// Every facet clipped for every present site by every other one. O(F n^2).
inline std::vector<geom::RestrictedPower::Canonical> restricted_power_diagram(
    const geom::TriMesh& mesh, const geom::Clipper::Sites& sites, const std::vector<geom::SiteId>& present) {
  const double extent = 10 * mesh.box().min().cwiseAbs().cwiseMax(mesh.box().max().cwiseAbs()).maxCoeff();
  geom::Clipper clipper(mesh, sites, extent);
  std::vector<geom::RestrictedPower::Canonical> result;
  geom::FacetPolygon polygon;
  for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1))
    for (const geom::SiteId i : present) {
      clipper.start(polygon, t, i);
      for (const geom::SiteId j : present)
        if (j != i && !polygon.corners.empty()) clipper.clip(polygon, j);
      if (polygon.corners.empty()) continue;
      geom::RestrictedPower::Canonical fragment{t, i, {}};
      for (const geom::PolygonCorner& corner : polygon.corners) fragment.labels.push_back(corner.edge);
      std::rotate(fragment.labels.begin(), std::ranges::min_element(fragment.labels), fragment.labels.end());
      result.push_back(std::move(fragment));
    }
  std::ranges::sort(result);
  return result;
}

/// The present site of smallest power at x, in doubles.
inline geom::SiteId nearest(const geom::Vec3& x, const geom::Clipper::Sites& sites,
                            const std::vector<geom::SiteId>& present) {
  return *std::ranges::min_element(present, {}, [&](geom::SiteId s) { return geom::power(x, sites[s]); });
}

}  // namespace oracle
