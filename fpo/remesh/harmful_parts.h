#pragma once
// Parts of creases that are given up after a remesh for the small angles beside them (angles_at_curves.h).

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fpo/remesh/angles_at_curves.h"

namespace fpo {

using FeatureEdge = std::array<geom::VertexId, 2>;  ///< of the surface

/// Edges of one crease.
struct CreasePart {
  std::size_t curve = 0;
  std::vector<FeatureEdge> edges;
  bool is_whole = false;  ///< are these all that it has?
  double lacking = 0;     ///< in the angles that it is to blame for
  double strength = 0;    ///< what there is of it to be seen (weak_curves.h)
};

/// In spacings of a crease folded by 90 degrees: what angles are worth that lack so much in all.
double worth_of_angles(double lacking);

struct HarmOptions {
  double spacing = 0;
  std::span<const FeatureEdge> spared = {};  ///< no part with any of these is to blame
};

/// The parts of creases that are not worth the angles below 30 degrees beside them, and the faults, each as
/// bad as an angle of nothing between the creases within .7 spacings of it. To blame for a triangle with such
/// an angle, if at least two of its vertices are on features, is one of the creases that these are on, or of
/// the two that the angle is between: the part of it that is near to the others, within .7 spacings, or all
/// of it if there is no other, or hardly anything would be left; of all these that of which there is the
/// least to be seen (weak_curves.h). A part goes if what its angles lack is worth as much as there is of it
/// to be seen, at ten spacings each (of two long edges at 20 degrees, 2 spacings for 3.3);
/// those that are worth the least first, as long as half is left of all that there is to be seen. In that
/// order. O(small angles * edges of curves), and seen_curves() if there is any.
std::vector<CreasePart> harmful_parts(const geom::TriMesh& surface, const Features& features,
                                      const RemeshWithCurves& remesh, const HarmOptions& options);

}  // namespace fpo
