#pragma once
// What a move in a tile (tile_domain.h) may read and touch, so that tiles do not notice each other.
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
// The tests are made with upper bounds. Of what removing x vacates, and of the heirs' cells, the power is at
// most that which the heirs reach, and both are tested when x is out; if they fail, x is put back. Of what x
// wins at a new place z, where the nearest site y had the power P(z), a location q had power P(q) <= (|q - z|
// + |z - y|)^2 - w_y, tested when x is in, else all is undone.

#include <vector>

#include "fpo/surface/surface_removal.h"
#include "fpo/tiles/tiles.h"

namespace fpo {

class TileGuard final : public MoveGuard {
 public:
  /// Keeps a reference to the tile. `margin`: far more than positions are off.
  TileGuard(const Tile& tile, double margin) : tile_(tile), margin_(margin) {}

  /// M of tile_domain.h.
  void set_most_power(double power) { most_power_ = power; }
  double most_power() const { return most_power_; }

  /// The radius of the largest ball about that center in the tile's box; negative outside.
  double room_around(const geom::Vec3& center) const;
  /// False if x is so near to a cut that it can hardly be removed.
  bool is_clear_of_cuts(SurfaceDomain& domain, SiteId x) const;
  bool may_vacate(SurfaceRemoval& removal, Scope scope) override;
  bool offers(const geom::EmptyCircle& circle, const geom::WeightedPoint3& site) const override;
  /// If not, the circle is not offered again.
  bool may_keep(SurfaceDomain& domain, SiteId x, const geom::EmptyCircle& circle) override;

 private:
  bool holds_ball(const geom::Vec3& center, double radius) const;
  bool holds_cell(const geom::WeightedPoint3& site, double reach, double power) const;
  bool holds(SurfaceRemoval& removal, Scope scope) const;
  bool holds_heirs(SurfaceDomain& domain, const SurfaceRemoval::Vacancy& vacancy) const;

  const Tile& tile_;
  double margin_;
  double most_power_ = 0;
  std::vector<geom::Vec3> barred_;  ///< centers of circles where an insertion turned out to change too much
};

}  // namespace fpo
