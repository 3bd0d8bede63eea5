#pragma once
// Where long edges of creases are cut, so that what is given up of them (harmful_parts.h) ends where it
// does no harm: edges of machined parts are often as long as the part.

#include <vector>

#include "fpo/remesh/angles_at_curves.h"
#include "fpo/surface/cut_edges.h"

namespace fpo {

/// On edges of creases beside small angles and faults: where they cease to be within .7 spacings of another
/// crease that is to blame, going away from the triangle, to a twentieth of a spacing; nearer to their ends
/// than a third of a spacing they are not cut. O(small angles * edges of curves), and the edges' lengths in
/// twentieths of spacings each times that at worst.
std::vector<EdgeCut> crease_cuts(const geom::TriMesh& surface, const Features& features,
                                 const RemeshWithCurves& remesh, double spacing);

}  // namespace fpo
