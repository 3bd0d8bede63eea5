#pragma once
// The part of the surface that a triangle of the remesh stands for.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "fpo/remesh/prism.h"
#include "fpo/remesh/triangle_distances.h"
#include "geom/mesh/distance_from_triangle.h"

namespace fpo {

/// Distances of the surface from triangles of samples on it. What belongs to a triangle is what is joined to
/// a corner within its prism: over the triangle and .6 of its heights around it, as high above and below
/// as its longest edge, on facets that are turned as the corners' are. Along a facet the distance from a
/// triangle is convex, so that what is left of the facets' edges in the prism shows the largest one.
class SurfaceAbove {
 public:
  using Beside = std::function<void(std::vector<geom::DistanceFromTriangle>&)>;

  explicit SurfaceAbove(const geom::TriMesh& mesh) : mesh_(mesh) {}

  struct Wanted {
    double enough;                                          ///< no point that is not farther
    double most = std::numeric_limits<double>::infinity();  ///< of points beyond that any one will do
  };
  /// The farthest point among those that are nearer to this triangle than to those beside it, which
  /// `beside` adds, nearest first, if it is asked; distance 0 if there is none that is wanted, or if the
  /// triangle has no area. `margin`: of the prism. O(facets in the prism).
  FarPoint farthest(const std::array<SurfaceSample, 3>& corners, const Wanted& wanted, const Beside& beside,
                    double margin = 1);

  std::size_t looks() const { return looks_; }  ///< at edges of the surface, so far: most of what it has cost

 private:
  class Query;
  struct SeenVertex {
    std::uint32_t query = 0;  ///< the last one
    double distance2 = 0;     ///< from its triangle
    Prism::Depths depths{};   ///< in its prism
    double within2 = -1;      ///< to which of those beside it is it that near? (Squared)
    std::uint64_t near = 0;   ///< to these
    std::uint32_t asked = 0;  ///< of the first so many
  };

  void begin();
  bool is_reached(geom::FacetId t) const { return reached_[t] == query_; }

  const geom::TriMesh& mesh_;
  std::size_t looks_ = 0;
  std::uint32_t query_ = 0;                                   ///< its number
  geom::Table<geom::FacetId, std::uint32_t> reached_, done_;  ///< the last query that did it
  geom::Table<geom::VertexId, SeenVertex> seen_;
  std::vector<geom::FacetId> facets_;  ///< scratch, and so is:
  std::vector<geom::DistanceFromTriangle> beside_;
};

}  // namespace fpo
