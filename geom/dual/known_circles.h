#pragma once
// The part of a diagram that is known before it is built (known_cell.h): its circles are put where they are,
// and only the rest of the surface is divided.
//
// A regular cell has one border through all of its circles, and distinct sites around it: an edge of the
// diagram beside it runs between the two of its circles that touch the same other site. What is left are
// circles that touch no known cell, and edges between two cells that are not known. They are in cells that
// are not known, so on facets that such a site comes near to, by the bound of the power.

#include <vector>

#include "geom/dual/known_cell.h"
#include "geom/dual/state.h"

namespace geom {

/// Creates the circles that touch known cells, joins those along edges beside such a cell, and sets the
/// reaches of these.
void create_known(const KnownDiagram& known, DualState& state, DualChange& change);

/// The facets where a cell may be that is not known, along the curve; all if no circle is known.
std::vector<FacetId> facets_to_divide(const KnownDiagram& known, const DualState& state);

}  // namespace geom
