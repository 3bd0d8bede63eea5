#pragma once
// A remesh computed near the origin, in a box of unit size (geom/mesh/centring.h, geom/mesh/scaling.h), and
// brought back.

#include "fpo/remesh/stand_in_remesh.h"

namespace fpo {

/// `remesh`: gets the surface moved and scaled, and options in its lengths. Errors: those of fpo::remesh().
RemeshResult remesh_in_unit_box(const geom::TriMesh& input, const RemeshOptions& options,
                                const RemeshFunction& remesh);

}  // namespace fpo
