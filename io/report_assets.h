#pragma once
// The files report.css and report_view.js, which CMake puts into the program.

#include <string_view>

namespace io {

/// What makes a report look as it does, in light and dark.
std::string_view report_style();
/// What draws its scenes.
std::string_view report_script();

}  // namespace io
