#pragma once
// Inputs of which hardly anything would be left are refused, instead of remeshed to a remnant.

#include <cstddef>

#include "geom/mesh/trimesh.h"

namespace fpo {

/// Refuses a surface in more than eight pieces of which most of the area lies in pieces that get fewer than
/// four of that many samples: they can make no surface. `parts`: facets joined by edges. Throws
/// geom::InputError. O(F log F).
void refuse_soup(const geom::TriMesh& surface, std::size_t parts, std::size_t num_samples);

/// More than a quarter of the vertices have no triangle: much of the surface is missing. O(F log F).
bool is_remnant(const geom::TriMesh& remesh);

/// Refuses such a remesh. `enough`: a number of samples that is known to do, or 0. Throws geom::InputError.
void refuse_remnant(const geom::TriMesh& remesh, std::size_t enough = 0);

}  // namespace fpo
