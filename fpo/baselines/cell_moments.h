#pragma once
// Masses and centroids of restricted Voronoi cells, for methods that move all samples at once.

#include <vector>

#include "fpo/baselines/voronoi_facets.h"
#include "fpo/surface/sizing.h"

namespace fpo {

/// Integrals over a cell of the density d, about its site p.
struct CellMoments {
  double mass = 0;            ///< integral of d
  geom::Vec3 first{0, 0, 0};  ///< integral of d (x - p): mass times (centroid - p)
  double second = 0;          ///< integral of d |x - p|^2: the cell's share of the CVT energy

  CellMoments& operator+=(const CellMoments& other) {
    mass += other.mass, first += other.first, second += other.second;
    return *this;
  }
};

/// The moments of the cells of changing sites on one surface, with density 1 if the sizing is uniform, else
/// (h_0 / h)^4: so that in a centroidal tessellation cell diameters are proportional to h.
class VoronoiMoments {
 public:
  /// Keeps references. h_0 = unit_length only scales the density. `threads` at least 1; no matter to the
  /// result.
  VoronoiMoments(const geom::TriMesh& surface, const Sizing& sizing, double unit_length, int threads);
  VoronoiMoments(const VoronoiMoments&) = delete;
  VoronoiMoments& operator=(const VoronoiMoments&) = delete;

  /// Of the restricted Voronoi diagram of these samples. Integrals are by the rule of edge midpoints on each
  /// triangle of a fragment: exact, up to rounding, if the density is constant. A hidden sample (one at the
  /// place of another) has none. O(n log n + fragments). Valid until the next call.
  const geom::Table<geom::SiteId, CellMoments>& of(const std::vector<SurfaceSample>& samples);

 private:
  struct Piece {
    geom::SiteId site;
    CellMoments moments;
  };
  CellMoments integrate(const geom::FacetPolygon& polygon) const;

  const Sizing& sizing_;
  double unit_length_;
  VoronoiFacets facets_;
  geom::Table<geom::SiteId, CellMoments> moments_;
};

}  // namespace fpo
