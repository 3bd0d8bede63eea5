#pragma once
// Small angles where no change by itself makes any better: beside curves as close as samples are, a vertex
// makes room for the next only if it first makes its own triangles worse.
//
// Simulated annealing (Kirkpatrick, Gelatt, Vecchi, Optimization by simulated annealing, 1983): vertices
// around are moved at random, with flips (angle_edits.h). What makes the penalty larger by d, in squared
// degrees, is kept with probability exp(-d / T), T going from ten to almost nothing.

#include "fpo/remesh/angle_edits.h"

namespace fpo {

/// Around a facet: some thousand moves, until nothing is bad there. True if the best that was seen is better
/// than what was there (AngleEdits::is_better), or fewer are bad and the smallest angle is no smaller, or
/// good, and nothing is folded by more than 120 degrees that was not: it is there now. Else all is as before.
/// Deterministic.
bool anneal_angles(AngleEdits& edits, geom::FacetId t, geom::Rng& rng);

}  // namespace fpo
