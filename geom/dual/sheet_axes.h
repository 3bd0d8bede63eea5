#pragma once
// The axes of a sheet, and bounds of its slopes along them with room for rounding: what charts measure in.

#include "geom/dual/sheets.h"

namespace geom {

struct SheetAxes {
  static constexpr double steeper = 1 + 1e-6;

  SheetAxes() = default;
  explicit SheetAxes(const Sheet& sheet)
      : u(sheet.u),
        v(sheet.axis.cross(sheet.u)),
        m(sheet.axis),
        slope_u(steeper * sheet.slope_u),
        slope_v(steeper * sheet.slope_v),
        slope2(steeper * sheet.slope * sheet.slope) {}

  Vec3 u{1, 0, 0}, v{0, 1, 0}, m{0, 0, 1};
  double slope_u = 0, slope_v = 0, slope2 = 0;
};

}  // namespace geom
