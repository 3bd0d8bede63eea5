#pragma once
// Masses and centroids of restricted Voronoi cells, for methods that move all samples at once.
//
// The diagram of geom/restricted_power.h is made for moves of single samples. Here every facet is clipped anew
// for each set of sites, by the same exact clipper and hence into the same fragments, but independently of the
// other facets: some ten times faster than n insertions, and on several threads. Sites that may own a part of a
// facet come from spatial search with the certificate of the security radius: if the farthest corner of a
// fragment of p is at distance R from p, no site farther than 2 R from p takes a part of it.

#include <vector>

#include "fpo/sizing.h"
#include "geom/clip.h"
#include "geom/site_tree.h"

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
  /// Keeps references. h_0 = unit_length only scales the density. `threads` at least 1; no matter to the result.
  VoronoiMoments(const geom::TriMesh& surface, const Sizing& sizing, double unit_length, int threads);
  VoronoiMoments(const VoronoiMoments&) = delete;
  VoronoiMoments& operator=(const VoronoiMoments&) = delete;

  /// Of the restricted Voronoi diagram of these samples. Integrals are by the rule of edge midpoints on each
  /// triangle of a fragment: exact, up to rounding, if the density is constant. A hidden sample (one at the
  /// place of another) has none. O(n log n + fragments). Valid until the next call.
  const geom::Table<geom::SiteId, CellMoments>& of(const std::vector<SurfaceSample>& samples);

 private:
  struct Near {
    double distance;
    geom::SiteId site;
    auto operator<=>(const Near&) const = default;
  };
  /// What is near a site: all sites up to a distance, nearest first.
  struct Neighbourhood {
    double radius;
    std::vector<Near> sites;
  };
  struct Piece {
    geom::SiteId site;
    CellMoments moments;
  };
  /// What a thread works with.
  struct Lane {
    geom::Clipper clipper;
    geom::FacetPolygon polygon;
    std::vector<geom::SiteId> owners, found;
    std::vector<Piece> pieces;
  };

  void find_neighbours(const std::vector<SurfaceSample>& samples);
  std::vector<Near> sites_within(geom::SiteId p, double radius) const;
  void clip_facet(geom::FacetId t, Lane& lane) const;
  void clip_to_cell(Lane& lane) const;
  CellMoments integrate(const geom::FacetPolygon& polygon) const;
  double density(const geom::Vec3& x, geom::FacetId t) const;

  const geom::TriMesh& surface_;
  const Sizing& sizing_;
  double unit_length_;
  geom::Clipper::Sites sites_;
  geom::SiteTree tree_;
  geom::Table<geom::SiteId, Neighbourhood> near_;
  std::vector<Lane> lanes_;
  geom::Table<geom::SiteId, CellMoments> moments_;
};

}  // namespace fpo
