#pragma once
// A partition of space into boxes, the tiles, with about equally many samples each, for moves that do not
// know of each other (tile_domain.h).

#include <cstdint>
#include <span>
#include <vector>

#include "fpo/surface/surface_sample.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// A rotation; its rows are the axes of the boxes.
using Frame = Eigen::Matrix3d;

/// The coordinates of x in the frame.
inline geom::Vec3 in_frame(const Frame& frame, const geom::Vec3& x) { return frame * x; }

struct Tile {
  Frame frame = Frame::Identity();  ///< of the box; the same for all tiles
  geom::Box3 box;  ///< infinite where no other tile is: the boxes fill space and do not overlap inside
  std::vector<geom::SiteId> samples;  ///< in the box; ascending; each sample is in one tile
  geom::Box3 sample_box;              ///< of these
  std::vector<geom::FacetId> facets;  ///< of which the box meets the tile's; ascending
};

/// What it costs if a cut passes within that distance of a sample.
struct CutCost {
  double cost = 0, within = 0;
};

struct TilingOptions {
  std::size_t most_samples = 3000;          ///< in a tile
  std::uint64_t seed = 1;                   ///< of where the cuts are
  std::span<const CutCost> cut_costs = {};  ///< one a sample, or none: all cuts are equally good
};

/// Cuts the samples' box, in a random frame, across its longest side, and each part again, all as often, so
/// that tiles are about as large as each other, and until none has too many samples (or all of its samples
/// lie at one place). A cut passes at a random one of the middle samples: at the one of several tries that
/// costs least. A function of the arguments. O(F log n + n log^2 n).
std::vector<Tile> make_tiles(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const TilingOptions& options);

}  // namespace fpo
