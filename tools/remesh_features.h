#pragma once
// --features: which curves of the input are kept.

#include "tools/remesh_arguments.h"

namespace tools {

/// A list of auto, none or an angle, and of what else is marked in the input: seams (of texture coordinates),
/// groups (their borders, and those of objects and materials), lines (OBJ: l), files of polylines (lines "x y
/// z" at vertices of INPUT, a blank line between two).
void set_features(RemeshArguments& a, const std::string& text);

/// Marks the edges of the surface that the list names. Adds to the notes how many pieces of lines are no
/// edges of it. Throws geom::InputError on files that cannot be read, and points that are no vertices.
void mark_features(RemeshArguments& a, SurfaceInput& input);

}  // namespace tools
