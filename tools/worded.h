#pragma once
// How tools make text of numbers.

#include <string>

namespace tools {

/// printf into a string.
std::string worded(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace tools
