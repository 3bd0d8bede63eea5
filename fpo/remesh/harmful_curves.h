#pragma once
// Creases that are given up after a remesh for the small angles beside them. The paper (section 5) keeps all
// features that it is given; of two lines that come closer to each other than samples, or meet at a point,
// no triangles between are good. Which these are is seen best from a remesh.

#include <cstddef>
#include <vector>

#include "fpo/features/features.h"

namespace fpo {

/// A remesh whose first vertices are the samples on features of a surface.
struct RemeshWithCurves {
  const geom::TriMesh& mesh;
  std::size_t on_features = 0;
};

/// What angles below 28 degrees lack in all, the smallest of each triangle: 1 for no angle, half for 14. Two
/// degrees less than 30 are no reason to give up a crease. O(F).
double lacking_in_angles(const geom::TriMesh& remesh);

/// The creases that are not worth the angles below 28 degrees beside them. Of each triangle with such an
/// angle, unless that is one between curves of the input, the weakest crease (weak_curves.h) that it has a
/// vertex on is to blame, if at least two vertices are on features. A crease goes if what its angles lack is
/// worth as much as there is of it to be seen, at ten spacings each; those that are worth the least first,
/// as long as half is left of all that there is to be seen. In that order. O(small angles * edges of curves),
/// and seen_curves() if there is any.
std::vector<std::size_t> harmful_curves(const geom::TriMesh& surface, const Features& features,
                                        const RemeshWithCurves& remesh, double spacing);

}  // namespace fpo
