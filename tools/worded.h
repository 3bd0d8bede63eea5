#pragma once
// How tools make text of numbers.

#include <cstddef>
#include <string>

namespace tools {

/// printf into a string.
std::string worded(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// "1 edge", "2 edges".
std::string counted(std::size_t count, const char* one, const char* more);

}  // namespace tools
