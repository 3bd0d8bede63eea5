#pragma once
// Farthest point optimization in one tile (tiles.h), without knowledge of what happens in the others at the
// same time, and yet exactly as if all moves were made one after the other on the whole surface: a guard
// (tile_guard.h) forbids what others could notice, or could change.
//
// The tile's diagram holds the facets that meet T and the sites that own anything of them: all within a
// certain power M of the box of these facets (of two such boxes, one along the axes of the tiles). The others
// can never be nearest where the power is at most M, which holds everywhere at first (certified, else M is
// increased) and is demanded of what a removal vacates.

#include <optional>
#include <span>
#include <vector>

#include "fpo/rest.h"
#include "fpo/surface/surface_domain.h"
#include "fpo/tiles/known_cells.h"
#include "fpo/tiles/tile_guard.h"
#include "fpo/tiles/tiles.h"
#include "geom/mesh/submesh.h"

namespace fpo {

/// What some facets are in.
struct FacetBoxes {
  Frame frame = Frame::Identity();
  geom::Box3 in_space, in_frame;
};

/// A surface with samples, ready to be looked at tile by tile. All samples' weights are those of the sizing.
class TiledSurface {
 public:
  /// Keeps references to all but the tiles. O(n).
  TiledSurface(const geom::TriMesh& mesh, const Sizing& sizing, std::span<const SurfaceSample> samples,
               const SurfaceOptions& options, std::vector<Tile> tiles);
  /// Keeps a reference to what is known of the samples' cells.
  void set_known(const KnownCells& known) { known_ = &known; }

  const geom::TriMesh& mesh() const { return mesh_; }
  const Sizing& sizing() const { return sizing_; }
  const SurfaceOptions& options() const { return options_; }
  const SurfaceSample& sample(SiteId x) const { return samples_[x.index()]; }
  std::span<const Tile> tiles() const { return tiles_; }
  /// Null: nothing is known.
  const KnownCells* known() const { return known_; }
  /// The largest wanted length at a sample of a tile.
  double largest_spacing(std::size_t tile) const { return spacings_[tile]; }

  /// All samples that have power at most M at some location of both boxes (maybe a few more), ascending.
  std::vector<SiteId> samples_near(const FacetBoxes& boxes, double M) const;

 private:
  double weight(SiteId x) const { return weights_.empty() ? 0 : weights_[x.index()]; }

  const geom::TriMesh& mesh_;
  const Sizing& sizing_;
  std::span<const SurfaceSample> samples_;
  const SurfaceOptions& options_;
  std::vector<Tile> tiles_;
  const KnownCells* known_ = nullptr;
  std::vector<double> weights_;       ///< rounded up; empty: all 0
  std::vector<double> tile_weights_;  ///< the largest in each tile
  std::vector<double> spacings_;
};

class TileDomain {
 public:
  /// Keeps references. The cost is that of a SurfaceDomain of the samples in the tile and some around it.
  TileDomain(const TiledSurface& whole, std::size_t tile);
  TileDomain(const TileDomain&) = delete;
  TileDomain& operator=(const TileDomain&) = delete;

  /// Domain::move() for a sample of the tile that is not fixed. Forbidden: it would read or change more than
  /// the tile holds. Scope::global: the farthest point that is well inside the tile.
  MoveOutcome move(SiteId of_whole, Scope scope);
  /// Those of the tile's samples that do not rest (rest.h), by what the tile knows.
  std::vector<SiteId> restless(std::span<const SiteId> of_whole, double rest_spacing);
  /// Domain::expect().
  void expect(SiteId x) { domain_->expect(here(x)); }

  /// When all is done: what is known of the cells of the tile's samples, and a bound of the power anywhere.
  void tell(KnownCells& known) const;
  double largest_reach() const;
  SurfaceSample sample(SiteId x) const;  ///< by its id in the whole, with its facet there
  const SurfaceDomain& domain() const { return *domain_; }
  SiteId whole_id(SiteId here) const { return sites_[here.index()]; }
  geom::FacetId whole_id(geom::FacetId here) const { return part_.facets[here.index()]; }

 private:
  void build();
  std::vector<geom::KnownCell> known_cells(const WeightedSamples& samples) const;
  std::vector<geom::EmptyCircle> known_circles(std::span<const geom::KnownCell> cells) const;
  Sizing local_sizing(std::vector<SurfaceSample>& samples);
  SiteId here(SiteId of_whole) const;

  const TiledSurface& whole_;
  const std::size_t number_;
  const Tile& tile_;
  geom::Submesh part_;
  geom::TriMesh sizing_mesh_;  ///< the facets of all samples, each by itself
  std::vector<SiteId> sites_;  ///< ascending
  TileGuard guard_;
  std::optional<SurfaceDomain> domain_;
};

}  // namespace fpo
