#pragma once
// Ragged borders (border_teeth.h): remeshed as they are or, where that does harm, without their teeth.

#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/stand_in_remesh.h"

namespace fpo {

/// The remesh of the surface. If that is not of its type, without some edges of curves or with angles below
/// 30 degrees, and nobody asked for features: perhaps that of what is left without teeth smaller than 1.5
/// spacings and sharper than 75 degrees or, if that does not do, than 2.5 and 85. It has to be of the type,
/// and to have at most half as many angles below 30 degrees where the other one is of the type as well. If
/// the whole is of another type, or by collapses (last_resort.h), only its way is tried. `given_up` says how
/// much was cut off. Samples, cells and sizes are those of the whole surface.
RemeshResult remesh_trimmed_or_not(const geom::TriMesh& surface, const RemeshOptions& options,
                                   const RemeshFunction& remesh);

}  // namespace fpo
