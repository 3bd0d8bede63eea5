#pragma once
// Width and height of the plane's rectangles on command lines.

#include <string>

#include "geom/vec.h"

namespace tools {

/// "2x1.5". Throws geom::InputError.
geom::Vec2 parse_period(const std::string& text);

}  // namespace tools
