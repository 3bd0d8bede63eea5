#pragma once
// What was found out about the cells of a diagram and the surface around them in one place, for another one
// in which both are the same.

#include <limits>
#include <span>

#include "geom/dual/empty_circles.h"
#include "geom/dual/sheets.h"
#include "geom/dual/site_shapes.h"

namespace geom {

struct KnownCell {
  CellShape shape = CellShape::unknown;                ///< unknown: to be found out; irregular: not worth it
  float way = std::numeric_limits<float>::infinity();  ///< of its last move: what it does next (leeway.h)
  Sheet sheet;                                         ///< near the site; of no width if none is known
};

/// Of a diagram that is going to be built.
struct KnownDiagram {
  std::span<const KnownCell> cells = {};  ///< one a site, or none at all
  /// All that touch a cell of regular shape, some maybe twice, and maybe others; who is beyond them does not
  /// count. Or none.
  std::span<const EmptyCircle> circles = {};
  std::span<const double> reaches =
      {};  ///< if there are circles: of each regular cell a bound of the power in it
  double power = std::numeric_limits<double>::infinity();  ///< a bound of it anywhere on the surface

  /// Are the circles of that site known?
  bool has_circles_of(SiteId s) const {
    return !circles.empty() && cells[s.index()].shape == CellShape::regular;
  }
  bool has_circles_of_any(const EmptyCircle& circle) const {
    for (const SiteId s : circle.sites)
      if (s.valid() && has_circles_of(s)) return true;
    return false;
  }
};

}  // namespace geom
