#pragma once
// Curves that face each other all along across a strip: rims of a plate or of a tube's wall, long edges of a
// bar. With samples side by side the strip has right triangles, whose smallest angle is atan (w / L), w the
// width and L the length of edges along the curves; with samples of one opposite to the middles of the
// other's edges it is atan (2 w / L), so that edges may be twice as long.
//
//      o-------o-------o-------o          o-------o-------o-------o
//      |    /  |    /  |    /  |          | \   /   \   /   \   / |
//      o-------o-------o-------o          o---o-------o-------o---o

#include <span>
#include <vector>

#include "fpo/features/curve_spacing.h"
#include "fpo/features/features.h"

namespace fpo {

/// The samples of `staggered` are to be opposite to the middles of the edges of `leading`.
struct FacingPair {
  std::size_t leading, staggered;  ///< curves
  double width;                    ///< of the strip between, the median
  double length;                   ///< of the leading curve
};

/// Pairs of which each faces the other along nearly all of its length, and whose ends are opposite to each
/// other (or which are loops). A curve may be in several, but leads in all or is staggered in all; where that
/// cannot be, the wider pairs are left out. Of curves that meet at corners all lead or all are staggered
/// where that can be. `places`: those of the same features. Ascending by width. O(places log places).
std::vector<FacingPair> facing_pairs(const geom::TriMesh& mesh, const Features& features,
                                     std::span<const NarrowPlace> places);

}  // namespace fpo
