#pragma once
// Wanted edge lengths from files, and how many samples they take.

#include "tools/remesh_arguments.h"

namespace tools {

/// --sizing KIND, FILE or FILE:PROPERTY.
void set_sizing(RemeshArguments& a, const std::string& text);

/// Reads the sizing's file, if it is given by one: a number a line (.txt or any other name), a vertex
/// property of a PLY file (`value`, which --sizing-out writes, unless another is named; `density` is samples
/// per area), or a gray image (dark is dense) seen by the texture coordinates of INPUT. Then settles the
/// number of samples and completes the options that depend on it. Adds to the notes what was made of the
/// lengths. Throws geom::InputError.
void settle_sizing(RemeshArguments& a, SurfaceInput& input);

}  // namespace tools
