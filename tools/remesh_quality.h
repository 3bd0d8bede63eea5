#pragma once
// How good, how long: --quality and --target-delta.

#include <string>

#include "fpo/remesh/effort.h"
#include "tools/remesh_arguments.h"

namespace tools {

/// draft, good or best. Throws geom::InputError on another word.
fpo::Effort effort_of(const std::string& text);

/// A target on the command line (not negative) wins.
void use_quality(RemeshArguments& a, fpo::Effort effort, double target_delta);

}  // namespace tools
