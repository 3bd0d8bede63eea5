#pragma once
// Where hardly anything is wrong with a remesh it is made again with other first samples: which of the few
// places where samples are short of room turn out well is luck.

#include "fpo/remesh/sheet_ways.h"

namespace fpo {

/// The result or, if it has a few flaws, the best of it and of at most three more with other seeds, which
/// follow from the options' seed: until one has the wanted angles, or the same smallest angle to the last bit
/// and as many: seeds do not matter to that, as where all three corners are on curves. Flaws are angles below
/// 30 degrees that are no corners of the input or, if it is of another type, the places where it is; a few, a
/// dozen at most. In the way in which the result was made, with its features. Nothing is tried where edges of
/// curves are lost, nor for a result by collapses, on another surface (stand_in.h) or with other lengths than
/// were asked for.
RemeshResult with_other_samples(const geom::TriMesh& surface, const RemeshOptions& options,
                                RemeshResult result, const RemeshWithFeatures& remesh);

}  // namespace fpo
