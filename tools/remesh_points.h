#pragma once
// The samples as a product of their own: --points.

#include "tools/remesh_arguments.h"

namespace tools {

/// .xyz: coordinates. .ply: normal (of the input, smooth but at its creases), area of the cell, facet (of the
/// surface as it was remeshed, from 0), size (wanted length), weight (what the sizing gives: (C size)^2) and
/// rank (fpo/surface/progressive.h). Throws geom::InputError.
void write_points(const RemeshArguments& a, const geom::TriMesh& input, const fpo::RemeshResult& result);

}  // namespace tools
