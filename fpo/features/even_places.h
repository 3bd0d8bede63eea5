#pragma once
// Farthest point optimization in one dimension, to its end.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fpo {

/// So many places in (0, length), or [0, length) of a loop, evenly spaced, ascending. Where those of a loop
/// begin is left to the optimization.
std::vector<double> even_places(double length, bool loop, std::size_t count, std::uint64_t seed);

}  // namespace fpo
