#pragma once
// The remesh of a coarser surface in the place of one that is made of needles (stand_in.h), or that has far
// more facets than samples where it is thinner than these are apart (coarse_start.h).

#include <functional>
#include <optional>

#include "fpo/features/features.h"
#include "fpo/remesh/pipeline.h"

namespace fpo {

using RemeshFunction = std::function<RemeshResult(const geom::TriMesh&, const RemeshOptions&)>;

/// The remesh of the coarser surface, its samples brought to the surface, its mesh not. None where the
/// surface is not made of needles, or no other can be had.
std::optional<RemeshResult> remesh_of_stand_in(const geom::TriMesh& surface, const RemeshOptions& options,
                                               const RemeshFunction& remesh);

/// Whether a coarser surface may stand in for this one: there are 45 facets a sample, no creases, and the
/// options ask for nothing that it has not. O(1) but for the curves.
bool may_be_coarser(const geom::TriMesh& surface, const Features& features, const RemeshOptions& options);

/// The remesh of that coarser surface for a sizing, as on_surface() makes it the result, with its type tested
/// again. None if there is no such surface, the input has edges of more than two facets, or hardly anything
/// would be left.
std::optional<RemeshResult> remesh_of_coarser(const geom::TriMesh& surface, const Sizing& sizing,
                                              const RemeshOptions& options, const RemeshFunction& remesh);

/// The remesh with its vertices where its samples are, on another surface of the same type than it was made
/// on. Its sizes are those of that surface. Angles are mended there (last_angles.h), and measured. If cells
/// are kept they are those that the samples have there.
RemeshResult with_mesh_on(const geom::TriMesh& surface, RemeshResult remesh, const RemeshOptions& options);

/// The coarser remesh as the result: if there is no time for another one, hardly anything would be left of
/// it, or it would be worse.
RemeshResult on_surface(RemeshResult coarse, const geom::TriMesh& surface, const Sizing& sizing,
                        const RemeshOptions& options);

}  // namespace fpo
