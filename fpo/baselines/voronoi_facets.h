#pragma once
// The restricted Voronoi diagram of changing sites, facet by facet, for integrals over it.
//
// The diagram of geom/power/restricted_power.h is made for moves of single samples. Here every facet is
// divided anew for each set of sites (geom/power/facet_cells.h), on several threads, and nothing is kept but
// what the visitor makes of each polygon.

#include <vector>

#include "fpo/surface/surface_sample.h"
#include "geom/parallel.h"
#include "geom/power/facet_cells.h"
#include "geom/sites/point_tree.h"

namespace fpo {

class VoronoiFacets {
 public:
  using Sites = geom::Clipper::Sites;

  /// Keeps a reference. Facets without area are left out. `threads` at least 1; no matter to the result.
  VoronoiFacets(const geom::TriMesh& surface, int threads);
  VoronoiFacets(const VoronoiFacets&) = delete;
  VoronoiFacets& operator=(const VoronoiFacets&) = delete;

  const Sites& sites() const { return sites_; }

  /// Divides all facets among these samples, and calls visit(polygon, pieces) for each polygon, from several
  /// threads: visit may read sites() and append to `pieces`. Returns the pieces of each thread; one list
  /// after the other they are in the order of the facets, however many threads there are. O(n log n +
  /// fragments).
  template <class Piece, class Visit>
  std::vector<std::vector<Piece>> pieces(const std::vector<SurfaceSample>& samples, const Visit& visit) {
    sites_.clear();
    positions_.clear();
    for (const SurfaceSample& x : samples) {
      sites_.push_back({x.position, 0});
      positions_.push_back(x.position);
    }
    const geom::PointTree tree(positions_);
    const std::size_t lanes = static_cast<std::size_t>(threads_), facets = facets_.size();
    std::vector<std::vector<Piece>> result(lanes);
    geom::parallel_ranges(lanes, 1, threads_, [&](std::size_t i, std::size_t) {
      geom::FacetCells cells(surface_, sites_, clipper_, tree);
      for (std::size_t k = facets * i / lanes; k < facets * (i + 1) / lanes; ++k)
        for (const geom::FacetPolygon& polygon : cells.divide(facets_[k])) visit(polygon, result[i]);
    });
    return result;
  }

 private:
  const geom::TriMesh& surface_;
  int threads_;
  std::vector<geom::FacetId> facets_;  ///< along a curve
  Sites sites_;
  std::vector<geom::Vec3> positions_;  ///< of the sites
  geom::Clipper clipper_;
};

}  // namespace fpo
