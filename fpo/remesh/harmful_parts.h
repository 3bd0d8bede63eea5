#pragma once
// Parts of creases that are given up after a remesh for the small angles beside them. The paper (section 5)
// keeps all features that it is given; of two lines that come closer to each other than samples, or meet at
// a small angle, no triangles between are good. Which these are is seen best from a remesh.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fpo/features/features.h"

namespace fpo {

/// A remesh whose first vertices are the samples on features of a surface, and the places where it is not of
/// the surface's type.
struct RemeshWithCurves {
  const geom::TriMesh& mesh;
  std::size_t on_features = 0;
  std::span<const geom::Vec3> faults = {};
};

using FeatureEdge = std::array<geom::VertexId, 2>;  ///< of the surface

/// Edges of one crease.
struct CreasePart {
  std::size_t curve = 0;
  std::vector<FeatureEdge> edges;
  bool is_whole = false;  ///< are these all that it has?
  double lacking = 0;     ///< in the angles that it is to blame for
};

struct HarmOptions {
  double spacing = 0;
  std::span<const FeatureEdge> spared = {};  ///< no part with any of these is to blame
};

/// What angles below 30 degrees lack in all, the smallest of each triangle: 1 for no angle, half for 15.
/// O(F).
double lacking_in_angles(const geom::TriMesh& remesh);

/// The parts of creases that are not worth the angles below 30 degrees beside them, and the faults, each as
/// bad as an angle of nothing between the creases within .7 spacings of it. To blame for a triangle
/// with such an angle, if at least two of its vertices are on features, is one of the creases that these are
/// on, or of the two that the angle is between: the part of it that is near to the others, within .7
/// spacings, or all of it if there is no other, or hardly anything would be left; of all these that of which
/// there is the least to be seen (weak_curves.h). A part goes if what its angles lack is worth as much as
/// there is of it to be seen, at ten spacings each; those that are worth the least first, as long as half is
/// left of all that there is to be seen. In that order. O(small angles * edges of curves), and seen_curves()
/// if there is any.
std::vector<CreasePart> harmful_parts(const geom::TriMesh& surface, const Features& features,
                                      const RemeshWithCurves& remesh, const HarmOptions& options);

}  // namespace fpo
