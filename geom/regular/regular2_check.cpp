// The invariants of the triangulation on the torus.

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/regular/regular2.h"

namespace geom {

void Regular2::check() const {
  std::size_t live = 0, visible = 0;
  for (SimplexId t(0); t.index() < simplices_.size(); ++t.value) {
    if (!is_live(t)) continue;
    ++live;
    check_simplex(t);
  }
  ensure(live + free_.size() == simplices_.size(), "regular2: free triangles and live ones do not add up");
  for (SiteId id(0); id.index() < sites_.size(); ++id.value) {
    if (!contains(id)) continue;
    check_site(id);
    visible += !is_hidden(id);
  }
  // V - E + F = 0 with 3 F = 2 E.
  ensure(live == 2 * visible, "regular2: the Euler number of the torus is not 0");
  // Positively oriented triangles glued side to side cover the torus a whole number of times.
  ensure(std::lround(covered_area() / torus_.area()) == 1, "regular2: the torus is not covered once");
  ensure(recent_.valid() && is_live(recent_), "regular2: no live triangle at hand");
}

double Regular2::covered_area() const {
  double sum = 0;
  for (const Simplex& t : simplices_) {
    if (!t.corner[0].valid()) continue;
    const Vec2 b = difference(t.corner[0], t.corner[1]), c = difference(t.corner[0], t.corner[2]);
    sum += (b.x() * c.y() - b.y() * c.x()) / 2;
  }
  return sum;
}

void Regular2::check_simplex(SimplexId id) const {
  const Simplex& t = simplices_[id];
  std::array<Corner, 3> v;
  for (std::size_t k = 0; k < 3; ++k) {
    ensure(contains(t.corner[k]) && !is_hidden(t.corner[k]), "regular2: a corner is not a visible site");
    v[k] = seen_from(sites_[t.corner[0]], t.corner[k]);
  }
  const auto at = [](const Corner& c) { return Vec2(c.x, c.y); };
  ensure(orient2(at(v[0]), at(v[1]), at(v[2])) > 0, "regular2: a triangle is not counterclockwise");
  for (int k = 0; k < 3; ++k) {
    const Corner &a = v[static_cast<std::size_t>(next(k))], &b = v[static_cast<std::size_t>(previous(k))];
    ensure(torus_.is_short(b.x - a.x, b.y - a.y), "regular2: an edge is half a period or longer");
    const Side across = t.mate[static_cast<std::size_t>(k)];
    const Simplex& other = simplices_[across.simplex()];
    ensure(other.corner[0].valid(), "regular2: a neighbour is not live");
    ensure(other.mate[static_cast<std::size_t>(across.corner())] == Side(id, k),
           "regular2: neighbours disagree");
    ensure(other.corner[static_cast<std::size_t>(next(across.corner()))] == b.id &&
               other.corner[static_cast<std::size_t>(previous(across.corner()))] == a.id,
           "regular2: neighbours share no edge");
    const SiteId apex = other.corner[static_cast<std::size_t>(across.corner())];
    // The apex seen along the edge, so that the right copy is meant.
    const Corner beyond = seen_from(sites_[a.id], apex);
    const WeightedPoint2 e{{a.x + beyond.x, a.y + beyond.y}, beyond.weight};
    std::array<WeightedPoint2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {at(v[i]), v[i].weight};
    if (std::find(t.corner.begin(), t.corner.end(), apex) == t.corner.end())
      ensure(!conflicts2({&p[0], v[0].id.value}, {&p[1], v[1].id.value}, {&p[2], v[2].id.value},
                         {&e, apex.value}),
             "regular2: a neighbour's apex is inside a circle");
  }
  for (SiteId h = t.first_hidden; h.valid(); h = sites_[h].next_hidden)
    ensure(sites_[h].at.simplex() == id, "regular2: a hidden site names another witness");
  const double size2 = std::abs(t.radius2) + weight_allowance_;
  const Vec2 o = torus_.shortest(center(id) - Vec2(sites_[t.corner[0]].x, sites_[t.corner[0]].y));
  ensure(!std::isnan(t.radius2), "regular2: a radius is not a number");
  if (!std::isinf(t.tolerance))
    ensure(std::abs(o.squaredNorm() - v[0].weight - t.radius2) <= 0x1p-20 * size2,
           "regular2: a dual vertex does not have its power to a corner");
}

void Regular2::check_site(SiteId id) const {
  const Site& s = sites_[id];
  const Simplex& t = simplices_[s.at.simplex()];
  ensure(t.corner[0].valid(), "regular2: a site is at a triangle that is not there");
  if (!is_hidden(id)) {
    ensure(t.corner[static_cast<std::size_t>(s.at.corner())] == id, "regular2: a site is not where it says");
    return;
  }
  const Corner base = seen_from(s, t.corner[0]);
  std::array<Vec2, 3> v;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner c = seen_from(sites_[t.corner[0]], t.corner[k]);
    v[k] = {base.x + c.x, base.y + c.y};
  }
  for (std::size_t k = 0; k < 3; ++k)
    ensure(orient2(v[k], v[(k + 1) % 3], Vec2(0, 0)) >= 0, "regular2: a hidden site is outside its witness");
  ensure(!in_conflict_exactly(t, id, 0), "regular2: a hidden site conflicts with its witness");
  SiteId h = t.first_hidden;
  while (h.valid() && h != id) h = sites_[h].next_hidden;
  ensure(h == id, "regular2: a hidden site is not in its witness's list");
}

}  // namespace geom
