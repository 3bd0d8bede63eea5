#pragma once
// Edges of features that the remesh lacks, for users: where, and how many samples would do.

#include <cstddef>
#include <span>
#include <utility>

#include "geom/mesh/trimesh.h"

namespace fpo {

struct EdgeAdvice {
  geom::Vec3 first = geom::Vec3::Zero();  ///< the middle of the first edge that is missing
  /// About: so many that the ball about each of them were empty if the samples that are in it stayed as far
  /// away; at most 36 times as many as there are. 0: none is missing.
  std::size_t samples = 0;
};

/// `missing`: broken_edges() of the remesh. O(missing edges * vertices).
EdgeAdvice edge_advice(const geom::TriMesh& remesh,
                       std::span<const std::pair<geom::SiteId, geom::SiteId>> missing);

}  // namespace fpo
