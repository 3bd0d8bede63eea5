#pragma once
// How much of a surface lies so near to another sheet of it that samples of one push those of the other: told
// from samples alone, before anything is optimized or split (sheet_levels.h says where, and costs more).

#include <span>

#include "fpo/surface/sizing.h"

namespace fpo {

/// The share of the samples that have another one nearer in space than `near` wanted lengths whose facet
/// faces the other way, by 120 degrees at least: both sides of a plate, the walls of a shell; but also the
/// two sides of a sharp edge, for it is not asked how far they are along the surface. An estimate by what
/// samples there are: of sheets .7 wanted lengths apart random ones see nine in ten. 0 if there are none.
/// O(n log n).
double share_on_near_sheets(const geom::TriMesh& mesh, const Sizing& sizing,
                            std::span<const SurfaceSample> samples, double near);

}  // namespace fpo
