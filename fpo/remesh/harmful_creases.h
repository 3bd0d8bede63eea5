#pragma once
// Creases that were kept are given up where angles beside them are small (harmful_parts.h).

#include "fpo/remesh/sheet_ways.h"

namespace fpo {

/// The result, or one with less of the creases: of the type that the result has not, a few faults being
/// worth that (a dozen at most), or better, lacking at most nine tenths as much in angles, and so much less
/// that it is worth half of what is given up (harmful_parts.h); two facets that cross each other, where
/// none did, count as an angle of nothing. Of what is left more is given up as long as that helps; where it
/// does not, and the others do harm then, some of these as well, or half of it, or another where one does
/// not. That takes at most three remeshes, in the way in which the result was made. If small angles are
/// left, and long edges are near to others in part, the same is done with these cut (crease_cuts.h), in two
/// remeshes, or one if that leads to another type; not if edges are marked. Nothing is given up for angles
/// that are not to be optimized, nor of a result by collapses, or with other lengths than were asked for;
/// not the last crease, none whose loss makes the others count as noise, and none that is marked.
RemeshResult without_harmful_creases(const geom::TriMesh& surface, const RemeshOptions& options,
                                     RemeshResult result, const RemeshWithFeatures& remesh);

}  // namespace fpo
