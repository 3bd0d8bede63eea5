// What insertion on the torus starts from.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geom/regular/triangulation2.h"

namespace geom {
namespace {

/// Adds triangles one by one, joined to those that are there.
class Tiling {
 public:
  explicit Tiling(Triangulation2& t) : t_(t) {}

  void add(SiteId a, SiteId b, SiteId c) {
    const Triangulation2::Site& origin = t_.sites[a];
    const SimplexId id = t_.create(t_.seen_from(origin, a), t_.seen_from(origin, b), t_.seen_from(origin, c));
    for (int k = 0; k < 3; ++k) {
      const Triangulation2::Triangle& corner = t_.simplices[id].corner;
      const SiteId from = corner[static_cast<std::size_t>(ccw(k))],
                   to = corner[static_cast<std::size_t>(cw(k))];
      const auto other = open_.find({to, from});
      if (other == open_.end())
        open_[{from, to}] = Triangulation2::Side(id, k);
      else
        t_.glue(Triangulation2::Side(id, k), other->second);
    }
  }

 private:
  Triangulation2& t_;
  std::map<std::pair<SiteId, SiteId>, Triangulation2::Side> open_;
};

}  // namespace

// Isosceles triangles between rows that are shifted by half a column in turn; at least 4 x 4, rows even,
// columns wider than high by less than 2, so all triangles are acute, hence Delaunay.
void start_with_lattice(Triangulation2& t, std::size_t first_id, double weight) {
  const Vec2& period = t.torus.period();
  const int columns = 4 * std::max(1, static_cast<int>(std::lround(period.x() / period.y())));
  const int rows = 4 * std::max(1, static_cast<int>(std::lround(period.y() / period.x())));
  const auto site = [&](int i, int j) {
    return SiteId(first_id + static_cast<std::size_t>((j % rows) * columns + i % columns));
  };
  t.change.clear();
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec2 place((i + (j % 2) * 0.5) / columns, static_cast<double>(j) / rows);
      t.admit(site(i, j), {place.cwiseProduct(period), weight});
    }
  }
  Tiling tiling(t);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int odd = j % 2;
      tiling.add(site(i, j), site(i + 1, j), site(i + odd, j + 1));
      tiling.add(site(i + 1 - odd, j), site(i + 1, j + 1), site(i, j + 1));
    }
  }
}

}  // namespace geom
