#include "geom/regular/regular2.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geom/check.h"
#include "geom/hilbert.h"
#include "geom/prefetch.h"

namespace geom {
namespace {

constexpr std::size_t max_sites = 200'000'000;  // side codes are int32: 4 * (2 n) < 2^31
constexpr double u = 0x1p-53;                   // unit roundoff

}  // namespace

// --- construction --------------------------------------------------------------------------------

// Insertion needs a triangulation to start from: a lattice of auxiliary sites, removed at the end. Their ids
// and places leave no trace, since the triangulation is a function of its sites. Their weight is the least of
// all, so that no site is hidden by them which the others would not hide.
Regular2::Regular2(const Vec2& period, std::span<const WeightedPoint2> points) : torus_(period) {
  require(points.size() <= max_sites, "at most 200 million sites fit in a triangulation");
  double weight = points.empty() ? 0 : points[0].weight;
  std::vector<Vec2> positions;
  positions.reserve(points.size());
  for (const WeightedPoint2& p : points) {
    require(p.position.allFinite(), "a sample's position is not finite");
    positions.push_back(torus_.snap(p.position));
    weight = std::min(weight, p.weight);
  }
  simplices_.reserve(2 * points.size() + 64);
  start_with_lattice(points.size(), weight);
  for (const std::uint32_t i : hilbert_order(positions, torus_.period()))
    insert(SiteId(static_cast<std::size_t>(i)), points[i]);
  for (SiteId id(sites_.size() - 1); id.index() >= points.size() && id.valid(); --id.value) {
    remove(id);
    sites_.pop_back();
  }
}

// Isosceles triangles between rows that are shifted by half a column in turn; at least 4 x 4, rows even,
// columns wider than high by less than 2, so all triangles are acute, hence Delaunay.
void Regular2::start_with_lattice(std::size_t first_id, double weight) {
  const Vec2& period = torus_.period();
  const int columns = 4 * std::max(1, static_cast<int>(std::lround(period.x() / period.y())));
  const int rows = 4 * std::max(1, static_cast<int>(std::lround(period.y() / period.x())));
  const auto site = [&](int i, int j) {
    return SiteId(first_id + static_cast<std::size_t>((j % rows) * columns + i % columns));
  };
  begin_change();
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec2 place((i + (j % 2) * 0.5) / columns, static_cast<double>(j) / rows);
      admit(site(i, j), {place.cwiseProduct(period), weight});
    }
  }
  std::map<std::pair<SiteId, SiteId>, Side> open;
  const auto add = [&](SiteId a, SiteId b, SiteId c) {
    const Site& origin = sites_[a];
    const SimplexId t = create(seen_from(origin, a), seen_from(origin, b), seen_from(origin, c));
    for (int k = 0; k < 3; ++k) {
      const Triangle& corner = simplices_[t].corner;
      const SiteId from = corner[next(k)], to = corner[previous(k)];
      const auto other = open.find({to, from});
      if (other == open.end())
        open[{from, to}] = Side(t, k);
      else
        glue(Side(t, k), other->second);
    }
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int odd = j % 2;
      add(site(i, j), site(i + 1, j), site(i + odd, j + 1));
      add(site(i + 1 - odd, j), site(i + 1, j + 1), site(i, j + 1));
    }
  }
}

void Regular2::admit(SiteId id, const WeightedPoint2& point) {
  ensure(id.valid() && !contains(id), "a site is inserted under an id that is in use");
  require(point.position.allFinite(), "a sample's position is not finite");
  require(std::abs(point.weight) <= 0x1p20 * torus_.unit() * torus_.unit(),  // false for NaN
          "a sample's weight is not finite or too large for the period");
  if (id.index() >= sites_.size()) sites_.resize(id.index() + 1, Site{});
  const Vec2 x = torus_.snap(point.position);
  sites_[id] = {x.x(), x.y(), point.weight, Side(), not_hidden};
  weight_allowance_ = std::max(weight_allowance_, 3 * std::abs(point.weight));
}

// --- triangles -----------------------------------------------------------------------------------

SimplexId Regular2::create(const Corner& a, const Corner& b, const Corner& c) {
  SimplexId id;
  if (free_.empty()) {
    id = simplices_.next_id();
    simplices_.emplace_back();
  } else {
    id = free_.back();
    free_.pop_back();
  }
  Simplex& t = simplices_[id];
  t.corner = {a.id, b.id, c.id};
  t.first_hidden = SiteId();
  for (int k = 0; k < 3; ++k) sites_[t.corner[static_cast<std::size_t>(k)]].at = Side(id, k);
  // The corner of smallest id first; without branches, for they could not be predicted.
  const std::array<const Corner*, 5> around{&a, &b, &c, &a, &b};
  std::size_t base = b.id < a.id ? 1 : 0;
  base = c.id < around[base]->id ? 2 : base;
  set_dual(t, *around[base], *around[base + 1], *around[base + 2]);
  created_.push_back(id);
  recent_ = id;
  return id;
}

// With the base at the origin and B = |b|^2 - w_b + w_a (same for C) the center o solves 2 o.b = B, 2 o.c =
// C.
//
// Error. The differences b and c are exact. Let m = |b|^2 + |c|^2 + 4 max|w|, s the sum of the |coordinates|
// of b and c, P = |bx cy| + |by cx|. B and C carry at most 4u m, the numerators 7u m s, D carries 3u P; so o
// is off by at most e0 = 16u (m s + P |o|) / D, and by 8u U more once it is stored and compared as a
// coordinate on the torus: e = e0 + 8u U. The power of x to the circle, |x - o|^2 - w_x - radius2, is linear
// in o once radius2 = |o|^2 - w_a is put in, so its error is 2 e |x - base| <= 2 e (q^1/2 + R) with
// q = |x - o|^2, R = |o|, which is <= e (3 R + q / R). If 3 e <= 2^-21 R this is <= 2^-21 (R^2 + q), and
// R^2 <= |radius2| + max|w|. Rounding of the evaluation itself, some u of the same terms, is far below
// another 2^-21 of them. Hence the relative tolerance 2^-20 of the filter in in_conflict().
void Regular2::set_dual(Simplex& t, const Corner& base, const Corner& b, const Corner& c) {
  const double bx = b.x - base.x, by = b.y - base.y, cx = c.x - base.x, cy = c.y - base.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double bw = b2 - (b.weight - base.weight), cw = c2 - (c.weight - base.weight);
  const double permanent = std::abs(bx * cy) + std::abs(by * cx);
  double det = bx * cy - by * cx;
  if (det <= 64 * u * permanent) {  // nearly flat: a determinant good to two ulps, at least the grid's square
    const double p = bx * cy, q = by * cx;
    det = (p - q) + (std::fma(bx, cy, -p) - std::fma(by, cx, -q));
  }
  const double scale = 0.5 / det;
  const double ox = (bw * cy - cw * by) * scale, oy = (cw * bx - bw * cx) * scale;
  const double o2 = ox * ox + oy * oy;

  const double m = b2 + c2 + 2 * weight_allowance_,
               s = std::abs(bx) + std::abs(by) + std::abs(cx) + std::abs(cy);
  const double error =
      16 * u * (m * s + permanent * (std::abs(ox) + std::abs(oy))) + 8 * u * torus_.unit() * det;
  const double bound = 3 * 0x1p21 * error;
  const bool sharp = bound * bound <= det * det * o2;

  const Site& origin = sites_[base.id];
  t.center_x = torus_.wrap_x(origin.x + ox);
  t.center_y = torus_.wrap_y(origin.y + oy);
  if (!sharp) {
    const Vec2 far = torus_.snap({t.center_x, t.center_y});
    t.center_x = far.x();
    t.center_y = far.y();
  }
  t.radius2 = o2 - base.weight;
  t.tolerance = sharp ? 0x1p-20f : INFINITY;
}

/// Is site e inside the circle of t? `corner` is one of t's that is less than half a period from e.
bool Regular2::in_conflict_exactly(const Simplex& t, SiteId e, int corner) const {
  const Site& origin = sites_[e];
  std::array<WeightedPoint2, 3> p;
  const auto k0 = static_cast<std::size_t>(corner);
  const Corner base = seen_from(origin, t.corner[k0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner v = seen_from(sites_[t.corner[k0]], t.corner[k]);
    p[k] = {{base.x + v.x, base.y + v.y}, v.weight};
  }
  const WeightedPoint2 center{{0, 0}, origin.weight};
  return conflicts2({&p[0], t.corner[0].value}, {&p[1], t.corner[1].value}, {&p[2], t.corner[2].value},
                    {&center, e.value});
}

// --- queries -------------------------------------------------------------------------------------

/// A triangle that contains e, by a visibility walk on the unrolled plane: through any edge that separates
/// the triangle from e. Each step strictly lessens the power of e to the circle (infinitesimals included), so
/// the walk ends whichever such edge is taken.
SimplexId Regular2::locate(SiteId e, SimplexId start) const {
  SimplexId here = start;
  std::array<Vec2, 3> v;  // the corners seen from e
  v[0] = difference(e, simplices_[here].corner[0]);
  for (std::size_t k = 1; k < 3; ++k)
    v[k] = v[0] + difference(simplices_[here].corner[0], simplices_[here].corner[k]);
  const Vec2 target(0, 0);
  int entered = -1;
  for (;;) {
    const Simplex& t = simplices_[here];
    int exit = -1;
    for (int k = 0; k < 3 && exit < 0; ++k) {
      const auto from = static_cast<std::size_t>(next(k)), to = static_cast<std::size_t>(previous(k));
      if (k != entered && orient2(v[from], v[to], target) < 0) exit = k;
    }
    if (exit < 0) return here;
    const Side across = t.mate[static_cast<std::size_t>(exit)];
    const auto from = static_cast<std::size_t>(next(exit)), to = static_cast<std::size_t>(previous(exit));
    const auto far = static_cast<std::size_t>(across.corner());
    const SiteId apex = simplices_[across.simplex()].corner[far];
    const Vec2 a = v[from], b = v[to];
    // The edge runs from a to b here, from b to a there.
    v[far] = a + difference(t.corner[from], apex);
    v[static_cast<std::size_t>(next(across.corner()))] = b;
    v[static_cast<std::size_t>(previous(across.corner()))] = a;
    entered = across.corner();
    here = across.simplex();
  }
}

// If id owns its own position, the next owner there is a neighbour, or a site that only id's triangles hide.
// If not: the cells of a power diagram are convex, so from any cell but the nearest site's own some neighbour
// is strictly better, and a descent that starts below id's own power -w never meets id.
Regular2::Nearest Regular2::nearest_other(SiteId id) const {
  const Site& x = sites_[id];
  Nearest best{SiteId(), INFINITY};
  const auto consider = [&](SiteId other) {
    const Corner c = seen_from(x, other);
    const double p = c.x * c.x + c.y * c.y - c.weight;
    if (p < best.power || (p == best.power && other < best.id)) best = {other, p};
  };
  if (x.next_hidden == not_hidden) {
    visit_star(id, [&](SimplexId t, int corner) {
      const Simplex& simplex = simplices_[t];
      consider(simplex.corner[static_cast<std::size_t>(next(corner))]);
      for (SiteId h = simplex.first_hidden; h.valid(); h = sites_[h].next_hidden) consider(h);
    });
    if (best.power >= -x.weight) return best;
    if (is_hidden(best.id)) best = {SiteId(), INFINITY};
  }
  if (!best.id.valid()) consider(simplices_[x.at.simplex()].corner[x.at.corner() == 0 ? 1 : 0]);
  for (;;) {
    const SiteId from = best.id;
    visit_star(from, [&](SimplexId t, int corner) {
      const SiteId v = simplices_[t].corner[static_cast<std::size_t>(next(corner))];
      if (v != id) consider(v);
    });
    if (best.id == from) return best;
  }
}

void Regular2::prefetch_corner(SiteId id) const {
  const Side at = sites_[id].at;
  if (at.valid()) geom::prefetch(&simplices_[at.simplex()]);
}

void Regular2::prefetch_around(SiteId id) const {
  const Side at = sites_[id].at;
  if (!at.valid() || !is_live(at.simplex())) return;
  const Simplex& t = simplices_[at.simplex()];
  for (std::size_t k = 0; k < 3; ++k) {
    geom::prefetch(&simplices_[t.mate[k].simplex()]);
    geom::prefetch(&sites_[t.corner[k]]);
  }
}

void Regular2::prefetch_star(SiteId id) const {
  if (!contains(id) || is_hidden(id)) return;
  const Simplex& t = simplices_[sites_[id].at.simplex()];
  for (const Side side : t.mate) {
    const Simplex& beside = simplices_[side.simplex()];
    if (side.corner() < 0 || !beside.corner[0].valid()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      geom::prefetch(&simplices_[beside.mate[k].simplex()]);
      geom::prefetch(&sites_[beside.corner[k]]);
    }
  }
}

void Regular2::link(SiteId id, std::vector<SiteId>& out) const {
  out.clear();
  ensure(contains(id), "link of a site that is not in the triangulation");
  if (is_hidden(id)) return;
  visit_star(id, [&](SimplexId t, int corner) {
    out.push_back(simplices_[t].corner[static_cast<std::size_t>(next(corner))]);
  });
}

namespace {

Regular2::Triangle smallest_first(Regular2::Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

bool Regular2::simplex_before(SimplexId a, SimplexId b) const {
  return smallest_first(corners(a)) < smallest_first(corners(b));
}

std::vector<Regular2::Triangle> Regular2::triangles() const {
  std::vector<Triangle> live;
  for (const Simplex& t : simplices_) {
    if (t.corner[0].valid()) live.push_back(smallest_first(t.corner));
  }
  return live;
}

}  // namespace geom
