#pragma once
// A mesh made a surface: the steps that are asked for, one after the other.

#include <optional>
#include <string>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Steps, in this order; first of all the mesh is cleaned (clean.h). Lengths are the mesh's own.
struct RepairSteps {
  std::optional<double> weld;  ///< border edges whose ends are at most so far apart; T-junctions are zipped;
                               ///< negative: usual_tolerance() of weld.h
  bool split = false;          ///< sheets where more than two facets meet, and vertices where they touch
  std::optional<double> crumbs;  ///< drop parts of less than this share of the area; negative: parts.h
  bool orient = false;
  bool copies = false;          ///< drop parts that lie on another one (copies.h)
  std::optional<double> holes;  ///< close borders up to this length; negative: those of all_steps()
  bool dents = false;           ///< fill what is missing at borders (dents.h)
  bool spikes = false;          ///< before all others: outliers are moved back (spikes.h)
};

/// All of them, each with its usual limits: crumbs as in parts.h, copies as in copies.h, holes
/// as in holes.h, dents as in dents.h.
RepairSteps all_steps();

struct Repaired {
  TriMesh mesh;  ///< with the vertices that its facets name only, if any step changed anything
  std::vector<std::string> lines;  ///< one for each step that found something to do, or could not do it all
};

/// O(F log F), and what the steps' headers say. Deterministic. Throws InputError if nothing is left, or the
/// coordinates are beyond what scaling.h takes.
Repaired repaired(const TriMesh& mesh, const RepairSteps& steps);

}  // namespace geom
