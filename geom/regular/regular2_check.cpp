// The invariants of the regular triangulation on the torus.

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/regular/triangulation2.h"

namespace geom {

namespace {

double covered_area(const Triangulation2& m) {
  double sum = 0;
  for (const Triangulation2::Simplex& t : m.simplices) {
    if (!t.corner[0].valid()) continue;
    const Vec2 b = m.difference(t.corner[0], t.corner[1]), c = m.difference(t.corner[0], t.corner[2]);
    sum += (b.x() * c.y() - b.y() * c.x()) / 2;
  }
  return sum;
}

void check_simplex(const Triangulation2& m, SimplexId id) {
  const Triangulation2::Simplex& t = m.simplices[id];
  std::array<SeenSite, 3> v;
  for (std::size_t k = 0; k < 3; ++k) {
    ensure(m.contains(t.corner[k]) && !m.is_hidden(t.corner[k]), "regular2: a corner is not a visible site");
    v[k] = m.seen_from(m.sites[t.corner[0]], t.corner[k]);
  }
  const auto at = [](const SeenSite& c) { return Vec2(c.x, c.y); };
  ensure(orient2(at(v[0]), at(v[1]), at(v[2])) > 0, "regular2: a triangle is not counterclockwise");
  for (int k = 0; k < 3; ++k) {
    const SeenSite &a = v[static_cast<std::size_t>(ccw(k))], &b = v[static_cast<std::size_t>(cw(k))];
    ensure(m.torus.is_short(b.x - a.x, b.y - a.y), "regular2: an edge is half a period or longer");
    const Triangulation2::Side across = t.mate[static_cast<std::size_t>(k)];
    const Triangulation2::Simplex& other = m.simplices[across.simplex()];
    ensure(other.corner[0].valid(), "regular2: a neighbour is not live");
    ensure(other.mate[static_cast<std::size_t>(across.corner())] == Triangulation2::Side(id, k),
           "regular2: neighbours disagree");
    ensure(other.corner[static_cast<std::size_t>(ccw(across.corner()))] == b.id &&
               other.corner[static_cast<std::size_t>(cw(across.corner()))] == a.id,
           "regular2: neighbours share no edge");
    const SiteId apex = other.corner[static_cast<std::size_t>(across.corner())];
    // The apex seen along the edge, so that the right copy is meant.
    const SeenSite beyond = m.seen_from(m.sites[a.id], apex);
    const WeightedPoint2 e{{a.x + beyond.x, a.y + beyond.y}, beyond.weight};
    std::array<WeightedPoint2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {at(v[i]), v[i].weight};
    if (std::find(t.corner.begin(), t.corner.end(), apex) == t.corner.end())
      ensure(!conflicts2({&p[0], v[0].id.value}, {&p[1], v[1].id.value}, {&p[2], v[2].id.value},
                         {&e, apex.value}),
             "regular2: a neighbour's apex is inside a circle");
  }
  for (SiteId h = t.first_hidden; h.valid(); h = m.sites[h].next_hidden)
    ensure(m.sites[h].at.simplex() == id, "regular2: a hidden site names another witness");
  const double size2 = std::abs(t.circle.radius2) + m.weight_allowance;
  const Vec2 o = m.torus.shortest(Vec2(t.circle.center_x, t.circle.center_y) -
                                  Vec2(m.sites[t.corner[0]].x, m.sites[t.corner[0]].y));
  ensure(!std::isnan(t.circle.radius2), "regular2: a radius is not a number");
  if (!std::isinf(t.circle.tolerance))
    ensure(std::abs(o.squaredNorm() - v[0].weight - t.circle.radius2) <= 0x1p-20 * size2,
           "regular2: a dual vertex does not have its power to a corner");
}

void check_site(const Triangulation2& m, SiteId id) {
  const Triangulation2::Site& s = m.sites[id];
  const Triangulation2::Simplex& t = m.simplices[s.at.simplex()];
  ensure(t.corner[0].valid(), "regular2: a site is at a triangle that is not there");
  if (!m.is_hidden(id)) {
    ensure(t.corner[static_cast<std::size_t>(s.at.corner())] == id, "regular2: a site is not where it says");
    return;
  }
  const SeenSite base = m.seen_from(s, t.corner[0]);
  std::array<Vec2, 3> v;
  for (std::size_t k = 0; k < 3; ++k) {
    const SeenSite c = m.seen_from(m.sites[t.corner[0]], t.corner[k]);
    v[k] = {base.x + c.x, base.y + c.y};
  }
  for (std::size_t k = 0; k < 3; ++k)
    ensure(orient2(v[k], v[(k + 1) % 3], Vec2(0, 0)) >= 0, "regular2: a hidden site is outside its witness");
  ensure(!m.in_conflict_exactly(t, id, 0), "regular2: a hidden site conflicts with its witness");
  SiteId h = t.first_hidden;
  while (h.valid() && h != id) h = m.sites[h].next_hidden;
  ensure(h == id, "regular2: a hidden site is not in its witness's list");
}

}  // namespace

void check(const Triangulation2& m) {
  std::size_t live = 0, visible = 0;
  for (SimplexId t(0); t.index() < m.simplices.size(); ++t.value) {
    if (!m.is_live(t)) continue;
    ++live;
    check_simplex(m, t);
  }
  ensure(live + m.free.size() == m.simplices.size(), "regular2: free triangles and live ones do not add up");
  for (SiteId id(0); id.index() < m.sites.size(); ++id.value) {
    if (!m.contains(id)) continue;
    check_site(m, id);
    visible += !m.is_hidden(id);
  }
  // V - E + F = 0 with 3 F = 2 E.
  ensure(live == 2 * visible, "regular2: the Euler number of the torus is not 0");
  // Positively oriented triangles glued side to side cover the torus a whole number of times.
  ensure(std::lround(covered_area(m) / m.torus.area()) == 1, "regular2: the torus is not covered once");
  ensure(m.recent.valid() && m.is_live(m.recent), "regular2: no live triangle at hand");
}

}  // namespace geom
