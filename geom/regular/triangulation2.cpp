#include "geom/regular/triangulation2.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"

namespace geom {

void Triangulation2::admit(SiteId id, const WeightedPoint2& point) {
  ensure(id.valid() && !contains(id), "a site is inserted under an id that is in use");
  require(point.position.allFinite(), "a sample's position is not finite");
  require(std::abs(point.weight) <= 0x1p20 * torus.unit() * torus.unit(),  // false for NaN
          "a sample's weight is not finite or too large for the period");
  if (id.index() >= sites.size()) sites.resize(id.index() + 1, Site{});
  const Vec2 x = torus.snap(point.position);
  sites[id] = {x.x(), x.y(), point.weight, Side(), not_hidden};
  weight_allowance = std::max(weight_allowance, 3 * std::abs(point.weight));
}

SimplexId Triangulation2::create(const SeenSite& a, const SeenSite& b, const SeenSite& c) {
  SimplexId id;
  if (free.empty()) {
    id = simplices.next_id();
    simplices.emplace_back();
  } else {
    id = free.back();
    free.pop_back();
  }
  Simplex& t = simplices[id];
  t.corner = {a.id, b.id, c.id};
  t.first_hidden = SiteId();
  for (int k = 0; k < 3; ++k) sites[t.corner[static_cast<std::size_t>(k)]].at = Side(id, k);
  // The corner of smallest id first; without branches, for they could not be predicted.
  const std::array<const SeenSite*, 5> around{&a, &b, &c, &a, &b};
  std::size_t base = b.id < a.id ? 1 : 0;
  base = c.id < around[base]->id ? 2 : base;
  const Site& origin = sites[around[base]->id];
  t.circle.set(torus, {origin.x, origin.y}, {around[base], around[base + 1], around[base + 2]},
               weight_allowance);
  change.created.push_back(id);
  recent = id;
  return id;
}

bool Triangulation2::in_conflict_exactly(const Simplex& t, SiteId e, int corner) const {
  const Site& origin = sites[e];
  std::array<WeightedPoint2, 3> p;
  const auto k0 = static_cast<std::size_t>(corner);
  const SeenSite base = seen_from(origin, t.corner[k0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const SeenSite v = seen_from(sites[t.corner[k0]], t.corner[k]);
    p[k] = {{base.x + v.x, base.y + v.y}, v.weight};
  }
  const WeightedPoint2 center{{0, 0}, origin.weight};
  return conflicts2({&p[0], t.corner[0].value}, {&p[1], t.corner[1].value}, {&p[2], t.corner[2].value},
                    {&center, e.value});
}

/// A visibility walk on the unrolled plane: through any edge that separates the triangle from e. Each step
/// strictly lessens the power of e to the circle (infinitesimals included), so the walk ends whichever such
/// edge is taken.
SimplexId Triangulation2::locate(SiteId e, SimplexId start) const {
  SimplexId here = start;
  std::array<Vec2, 3> v;  // the corners seen from e
  v[0] = difference(e, simplices[here].corner[0]);
  for (std::size_t k = 1; k < 3; ++k)
    v[k] = v[0] + difference(simplices[here].corner[0], simplices[here].corner[k]);
  const Vec2 target(0, 0);
  int entered = -1;
  for (;;) {
    const Simplex& t = simplices[here];
    int exit = -1;
    for (int k = 0; k < 3 && exit < 0; ++k) {
      const auto from = static_cast<std::size_t>(ccw(k)), to = static_cast<std::size_t>(cw(k));
      if (k != entered && orient2(v[from], v[to], target) < 0) exit = k;
    }
    if (exit < 0) return here;
    const Side across = t.mate[static_cast<std::size_t>(exit)];
    const auto from = static_cast<std::size_t>(ccw(exit)), to = static_cast<std::size_t>(cw(exit));
    const auto far = static_cast<std::size_t>(across.corner());
    const SiteId apex = simplices[across.simplex()].corner[far];
    const Vec2 a = v[from], b = v[to];
    // The edge runs from a to b here, from b to a there.
    v[far] = a + difference(t.corner[from], apex);
    v[static_cast<std::size_t>(ccw(across.corner()))] = b;
    v[static_cast<std::size_t>(cw(across.corner()))] = a;
    entered = across.corner();
    here = across.simplex();
  }
}

}  // namespace geom
