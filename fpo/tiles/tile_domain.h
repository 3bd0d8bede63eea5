#pragma once
// Farthest point optimization in one tile (tiles.h), without knowledge of what happens in the others at the
// same time, and yet exactly as if all moves were made one after the other on the whole surface.
//
// Let T and T' be the boxes of two tiles, so apart from common sides disjoint. Call a site y a T-site if the
// ball about it of squared radius w_y lies inside T, and a location q with power P to the nearest site a
// T-location if the ball about it of squared radius max(P, 0) does. Then |q - y| > sqrt(P) + sqrt(w_y) >=
// sqrt(P + w_y) for a T-location q and a T'-site y: the site is not the nearest there, nor would be if it
// were put there. So if a tile
//   (1) moves T-sites only, and only to where they are T-sites,
//   (2) changes the owner of T-locations only: what a removal vacates, and what an insertion wins,
//   (3) decides by nothing else than the powers and owners of T-locations and, for circles on a cell
//       (Scope::two_ring), by the cells of T-sites that consist of T-locations,
// then nothing that T' does, before or after, changes what (3) sees: not the power nor the owner of a
// T-location; and T' gives no location to the cell of a T-site and takes none from it, all that it changes
// being T'-locations.
//
// The tile's diagram holds the facets that meet T and the sites that own anything of them: all within a
// certain power M of the box of these facets. The others can never be nearest where the power is at most M,
// which holds everywhere at first (certified, else M is increased) and is demanded of what a removal vacates.
//
// The tests are made with upper bounds. Of what removing x vacates, and of the heirs' cells, the power is at
// most that which the heirs reach, and both are tested when x is out; if they fail, x is put back. Of what x
// wins at a new place z, where the nearest site y had the power P(z), a location q had power P(q) <= (|q - z|
// + |z - y|)^2 - w_y, tested when x is in, else all is undone.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fpo/rest.h"
#include "fpo/surface/surface_domain.h"
#include "fpo/tiles/tiles.h"
#include "geom/mesh/submesh.h"

namespace fpo {

/// A surface with samples, ready to be looked at tile by tile. All samples' weights are those of the sizing.
class TiledSurface {
 public:
  /// Keeps references to all but the tiles. O(n).
  TiledSurface(const geom::TriMesh& mesh, const Sizing& sizing, std::span<const SurfaceSample> samples,
               const SurfaceOptions& options, std::vector<Tile> tiles);

  const geom::TriMesh& mesh() const { return mesh_; }
  const Sizing& sizing() const { return sizing_; }
  const SurfaceOptions& options() const { return options_; }
  const SurfaceSample& sample(SiteId x) const { return samples_[x.index()]; }
  std::span<const Tile> tiles() const { return tiles_; }
  /// The largest wanted length at a sample of a tile.
  double largest_spacing(std::size_t tile) const { return spacings_[tile]; }

  /// All samples that have power at most M at some location of the box (maybe a few more), ascending.
  std::vector<SiteId> samples_near(const geom::Box3& box, double M) const;

 private:
  double weight(SiteId x) const { return weights_.empty() ? 0 : weights_[x.index()]; }

  const geom::TriMesh& mesh_;
  const Sizing& sizing_;
  std::span<const SurfaceSample> samples_;
  const SurfaceOptions& options_;
  std::vector<Tile> tiles_;
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

  enum class Outcome {
    out_of_reach,  ///< nothing done: it would read or change more than the tile holds
    stayed,        ///< the sample has the best place already
    moved
  };
  /// Lines 4 to 9 of Algorithm 1 for a sample of the tile that is not fixed. Scope::global: the largest
  /// circle that is well inside the tile.
  Outcome move(SiteId of_whole, Scope scope);
  /// Those of the tile's samples that do not rest (rest.h), by what the tile knows.
  std::vector<SiteId> restless(std::span<const SiteId> of_whole, double rest_spacing);
  /// Domain::expect().
  void expect(SiteId x) { domain_->expect(here(x)); }

  SurfaceSample sample(SiteId x) const;  ///< by its id in the whole, with its facet there
  const SurfaceDomain& domain() const { return *domain_; }
  SiteId whole_id(SiteId here) const { return sites_[here.index()]; }
  geom::FacetId whole_id(geom::FacetId here) const { return part_.facets[here.index()]; }

 private:
  void build();
  double largest_reach() const;
  Sizing local_sizing(std::vector<SurfaceSample>& samples);
  SiteId here(SiteId of_whole) const;
  bool holds_ball(const geom::Vec3& center, double radius) const;
  double radius(SiteId x, double reach) const;
  template <class Holds>
  bool holds_by_reach(SiteId x, Holds holds);
  bool holds_cell(SiteId x, double reach, double power) const;
  /// Who has the place of x once it is out, and how much power there is then at most.
  struct Vacancy {
    double cell;  ///< radius of what x had
    double power;
    std::span<const SiteId> around;  ///< the heirs, or else the nearest site
    SiteId planned;                  ///< x if its removal is only planned
  };
  bool holds_vacancy(SiteId x, const Vacancy& vacancy) const;
  bool holds_heirs(const Vacancy& vacancy);
  std::optional<Outcome> move_directly(SiteId x, Scope scope);
  Outcome move_step_by_step(SiteId x, Scope scope);
  bool offers(const geom::EmptyCircle& circle, const geom::WeightedPoint3& site) const;
  bool holds_insertion(SiteId x, const geom::EmptyCircle& circle, double weight);

  const TiledSurface& whole_;
  const Tile& tile_;
  geom::Submesh part_;
  geom::TriMesh sizing_mesh_;  ///< the facets of all samples, each by itself
  std::vector<SiteId> sites_;  ///< ascending
  double most_power_ = 0;      ///< M
  double margin_;              ///< far more than positions are off
  std::optional<SurfaceDomain> domain_;
  std::vector<geom::Vec3> barred_;  ///< centers of circles where an insertion turned out to change too much
};

}  // namespace fpo
