#pragma once
// What was found out about the cell of a site and the surface around it in one diagram, for another one in
// which both are the same.

#include "geom/dual/sheets.h"
#include "geom/dual/site_shapes.h"

namespace geom {

struct KnownCell {
  CellShape shape = CellShape::unknown;  ///< unknown: to be found out; irregular: not worth it
  Sheet sheet;                           ///< near the site; of no width if none is known
};

}  // namespace geom
