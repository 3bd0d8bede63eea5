#pragma once
// Which way creases are folded. An edge of a machined part (paper, section 5) is convex, or concave, all
// along; folds of noise are both by turns.

#include "fpo/features/features.h"

namespace fpo {

struct FoldSides {
  std::size_t pairs = 0;     ///< of edges of creases that meet with no other at a vertex
  std::size_t opposite = 0;  ///< of these, those that are folded to opposite sides
};

/// Of all creases of a mesh, however its facets are turned. Folds of less than five degrees do not count: a
/// crease that is marked may be flat. O(E log E) for E edges of features.
FoldSides fold_sides(const geom::TriMesh& mesh, const Features& features);

/// Whether more than 15 percent of the pairs are opposite. By measurement, with creases of 45 degrees: on
/// machined parts none (joint 0 of 207, gear, hole-plate, screw) or nearly none (fandisk 1 of 688), with
/// noise of .1 percent of the diagonal at most .5 percent; on bodies as modelled 4 to 21 (homer), with that
/// noise up to 35; with noise of 1 percent 18 to 44, whatever the shape, but for joint (0 of 34 pairs that
/// are left). Less than twenty pairs say nothing.
bool is_noise(const FoldSides& sides);

}  // namespace fpo
