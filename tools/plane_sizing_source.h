#pragma once
// The sizing function that --sizing of fpo-plane names.

#include <memory>

#include "fpo/plane/plane_sizing.h"
#include "tools/plane_arguments.h"

namespace tools {

/// A named field, an image or curves. Throws geom::InputError, about a file with its name.
std::unique_ptr<fpo::PlaneSizing> make_plane_sizing(const PlaneArguments& a, const geom::FlatTorus& torus);

}  // namespace tools
