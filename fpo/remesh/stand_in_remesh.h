#pragma once
// The remesh of a coarser surface in the place of one that is made of needles (stand_in.h).

#include <functional>
#include <optional>

#include "fpo/remesh/pipeline.h"

namespace fpo {

using RemeshFunction = std::function<RemeshResult(const geom::TriMesh&, const RemeshOptions&)>;

/// The remesh of the coarser surface, its samples brought to the surface. None where the surface is not made
/// of needles, or no other can be had.
std::optional<RemeshResult> remesh_of_stand_in(const geom::TriMesh& surface, const RemeshOptions& options,
                                               const RemeshFunction& remesh);

/// It as the result, if there is no time for another one, or hardly anything would be left of it.
RemeshResult on_surface(RemeshResult coarse, const geom::TriMesh& surface, const Sizing& sizing);

}  // namespace fpo
