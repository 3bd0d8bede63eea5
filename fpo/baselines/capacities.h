#pragma once
// Capacities of restricted Voronoi cells, with the CVT energy, and how both change as samples move.
//
//      |   x         A location x of the wall between the cells of i and j is equally far from both. As the
//    i |   . j       sample i moves by v, the wall moves there by s, measured in the facet and away from i:
//      |             s = v . (x - x_i) / |P (x_j - x_i)|, P the projection onto the facet's plane. So with
//    wall            density d the capacity of i grows, and that of j shrinks, by the integral of d s over
//                    the wall.

#include <vector>

#include "fpo/baselines/polygon_density.h"
#include "fpo/baselines/voronoi_facets.h"
#include "fpo/surface/sizing.h"

namespace fpo {

/// Integrals over a cell: of the density d = (h_0 / h)^2, which is the wanted density of samples, and of its
/// square. In two dimensions a centroidal tessellation with density d^2 has a density of cells proportional
/// to d (Gersho's conjecture), so both call for the same.
struct CellCapacity {
  double capacity = 0;        ///< integral of d
  double mass = 0;            ///< integral of d^2
  geom::Vec3 first{0, 0, 0};  ///< integral of d^2 (x - p)
  double second = 0;          ///< integral of d^2 |x - p|^2: the cell's share of the CVT energy

  CellCapacity& operator+=(const CellCapacity& other);
};

/// A part of a wall, once for each side.
struct CellWall {
  geom::SiteId owner, other;
  geom::Vec3
      gain;  ///< derivative of the owner's capacity here by the owner's position; minus that of other's
};

class Capacities {
 public:
  /// Keeps references. h_0 = unit_length only scales the density, which is 1 if the sizing is uniform.
  /// `threads` at least 1; no matter to the result.
  Capacities(const geom::TriMesh& surface, const Sizing& sizing, double unit_length, int threads);

  struct Diagram {
    geom::Table<geom::SiteId, CellCapacity> cells;
    std::vector<CellWall> walls;
  };
  /// Of the restricted Voronoi diagram of these samples. Cells are integrated by the rule of edge midpoints
  /// on triangles, walls by Simpson's: exact, up to rounding, if the density is constant. O(n log n +
  /// fragments).
  Diagram of(const std::vector<SurfaceSample>& samples);

 private:
  struct Piece {
    geom::SiteId owner;
    CellCapacity cell;
    std::vector<CellWall> walls;
  };
  CellCapacity integrate(geom::SiteId owner, const PolygonDensity& density) const;
  geom::Vec3 gain(const geom::FacetPolygon& polygon, std::size_t k, const PolygonDensity& density) const;

  const geom::TriMesh& surface_;
  const Sizing& sizing_;
  double unit_length_;
  VoronoiFacets facets_;
};

}  // namespace fpo
