#pragma once
// fpo-plane --bounded: a rectangle with a border.

#include "tools/plane_arguments.h"

namespace tools {

/// Runs, writes and prints; returns the exit code.
int run_bounded_plane(PlaneArguments& a, std::uint64_t seed, bool quiet);

}  // namespace tools
