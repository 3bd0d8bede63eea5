#pragma once
// The same surface with facets that are small beside its sampling: a tile (tiles.h) holds all facets that
// meet it, and the samples around these.

#include <limits>
#include <span>

#include "fpo/surface/sizing.h"

namespace fpo {

struct SplitSurface {
  geom::TriMesh mesh;
  VertexField h;                                      ///< the wanted lengths; empty if uniform
  geom::Table<geom::FacetId, geom::FacetId> parents;  ///< the facet that each is a part of
};

/// Is there an edge longer than `most` times the smaller of the wanted lengths at its ends?
bool has_long_edges(const geom::TriMesh& mesh, const Sizing& sizing, double most);

/// Halves such edges until there are none, at middles rounded to the exact range (geom/mesh/scaling.h): parts
/// of a facet are in its plane up to rounding only. Needles are cut to few parts (needle_parts.h), other
/// facets to parts like themselves. The samples' facets become those of the parts; the old
/// vertices keep their ids. O(parts + samples) for each halving of the longest edge. Ends with edges that are
/// long when there are more than `most_parts`: needles make millions.
SplitSurface split_long_edges(const geom::TriMesh& mesh, const Sizing& sizing, double most,
                              std::span<SurfaceSample> samples,
                              std::size_t most_parts = std::numeric_limits<std::size_t>::max());

}  // namespace fpo
