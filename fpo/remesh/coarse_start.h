#pragma once
// A coarser surface for all iterations but the last, where cells have dozens of facets.
//
// A move looks at each facet of some cells. Of a dense scan with few samples that is most of its cost, and
// what facets far smaller than a cell add to the course of the surface matters little to where samples go. So
// these are optimized on a surface with facets about half as long as they are apart (stand_in.h), brought
// back, and settle in the last iterations on the surface itself. Not in the paper, whose surfaces have few
// facets a sample. The set is another one than without that, as if it came from other initial samples.
//
// Where the surface is thinner than the samples are apart, ways to its type are tried one after the other,
// each with a diagram made anew. There the whole remesh is made on a coarser surface (stand_in_remesh.h).

#include <cstddef>
#include <optional>

#include "fpo/optimize.h"
#include "fpo/surface/sizing.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// The coarser surface for n samples. Vertices keep their ids and places. None where there are fewer than 30
/// facets a sample, where it would have more than half of them, or where the surface has levels. Cost:
/// that of stand_in().
std::optional<geom::TriMesh> coarse_surface(const geom::TriMesh& surface, const Sizing& sizing,
                                            std::size_t n);
/// Whether there are 45 facets a sample.
bool is_dense_for_all(const geom::TriMesh& surface, std::size_t n);
/// The coarser surface for a whole remesh, some finer if that has no more than half of the facets: none where
/// it is not dense.
std::optional<geom::TriMesh> coarse_surface_for_all(const geom::TriMesh& surface, const Sizing& sizing,
                                                    std::size_t n);

/// The same sizing there. Keeps a reference to the coarser surface.
Sizing sizing_on(const geom::TriMesh& coarse, const Sizing& sizing);

/// Is an optimization of so many iterations long enough to be made in two parts?
bool has_two_parts(const OptimizeOptions& whole);
/// All iterations but the last ten; and what is left after these, whose reports and moves count on.
OptimizeOptions first_part(OptimizeOptions whole);
OptimizeOptions last_part(const OptimizeOptions& whole, const OptimizeResult& first);
/// What is told of both.
OptimizeResult both_parts(const OptimizeResult& first, OptimizeResult last);

}  // namespace fpo
