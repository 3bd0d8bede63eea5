#pragma once
// Where the topological ball property fails (paper, section 5): cells that are no disks, cells that meet in
// more than one arc. If there are none, the dual is of the surface's topological type (Edelsbrunner and Shah,
// Triangulating topological spaces, 1997).

#include <vector>

#include "fpo/remesh/extract.h"
#include "geom/power/restricted_power.h"

namespace fpo {

/// A cell that is no disk, or two cells that meet in several arcs, or in a circle.
struct CellFault {
  geom::SiteId cell, other;  ///< other: none if it is one cell
  /// How far it is around the narrowest place: the shortest loop of the cell's border; of two cells, which
  /// are a ring together, at most the sum of their borders' halves. 0 if there is no border.
  double girth;
  std::vector<geom::Vec3> around;  ///< corners of that loop, or where the two cells meet
};

/// All of them: lone cells first, each kind ascending. `owners`: fragments that belong to another cell than
/// their site's. Pieces on the surface's own borders belong to a cell's border. O(fragments log fragments).
std::vector<CellFault> cell_faults(const geom::RestrictedPower& diagram, const FragmentOwners& owners);

}  // namespace fpo
