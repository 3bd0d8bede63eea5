#include "geom/regular/regular2.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/hilbert.h"
#include "geom/prefetch.h"

namespace geom {
namespace {

constexpr std::size_t max_sites = 200'000'000;  // side codes are int32: 4 * (2 n) < 2^31

}  // namespace

// --- construction --------------------------------------------------------------------------------

// Insertion needs a triangulation to start from: a lattice of auxiliary sites, removed at the end. Their ids
// and places leave no trace, since the triangulation is a function of its sites. Their weight is the least of
// all, so that no site is hidden by them which the others would not hide.
Regular2::Regular2(const Vec2& period, std::span<const WeightedPoint2> points) : triangulation_(period) {
  require(points.size() <= max_sites, "at most 200 million sites fit in a triangulation");
  double weight = points.empty() ? 0 : points[0].weight;
  std::vector<Vec2> positions;
  positions.reserve(points.size());
  for (const WeightedPoint2& p : points) {
    require(p.position.allFinite(), "a sample's position is not finite");
    positions.push_back(torus().snap(p.position));
    weight = std::min(weight, p.weight);
  }
  triangulation_.simplices.reserve(2 * points.size() + 64);
  start_with_lattice(triangulation_, points.size(), weight);
  for (const std::uint32_t i : hilbert_order(positions, torus().period()))
    insert(SiteId(static_cast<std::size_t>(i)), points[i]);
  for (SiteId id(triangulation_.sites.size() - 1); id.index() >= points.size() && id.valid(); --id.value) {
    remove(id);
    triangulation_.sites.pop_back();
  }
}

Regular2::Change Regular2::insert(SiteId id, const WeightedPoint2& point, SimplexId hint) {
  triangulation_.change.clear();
  triangulation_.admit(id, point);
  insertion_.insert(triangulation_, id, hint);
  return triangulation_.change.view();
}

Regular2::Change Regular2::remove(SiteId id) {
  ensure(contains(id), "removal of a site that is not in the triangulation");
  triangulation_.change.clear();
  removal_.remove(triangulation_, id, insertion_);
  return triangulation_.change.view();
}

// If id owns its own position, the next owner there is a neighbour, or a site that only id's triangles hide.
// If not: the cells of a power diagram are convex, so from any cell but the nearest site's own some neighbour
// is strictly better, and a descent that starts below id's own power -w never meets id.
Regular2::Nearest Regular2::nearest_other(SiteId id) const {
  const Triangulation2& t = triangulation_;
  const Triangulation2::Site& x = t.sites[id];
  Nearest best{SiteId(), INFINITY};
  const auto consider = [&](SiteId other) {
    const SeenSite c = t.seen_from(x, other);
    const double p = c.x * c.x + c.y * c.y - c.weight;
    if (p < best.power || (p == best.power && other < best.id)) best = {other, p};
  };
  if (x.next_hidden == Triangulation2::not_hidden) {
    t.visit_star(id, [&](SimplexId s, int corner) {
      const Triangulation2::Simplex& simplex = t.simplices[s];
      consider(simplex.corner[static_cast<std::size_t>(ccw(corner))]);
      for (SiteId h = simplex.first_hidden; h.valid(); h = t.sites[h].next_hidden) consider(h);
    });
    if (best.power >= -x.weight) return best;
    if (t.is_hidden(best.id)) best = {SiteId(), INFINITY};
  }
  if (!best.id.valid()) consider(t.simplices[x.at.simplex()].corner[x.at.corner() == 0 ? 1 : 0]);
  for (;;) {
    const SiteId from = best.id;
    t.visit_star(from, [&](SimplexId s, int corner) {
      const SiteId v = t.simplices[s].corner[static_cast<std::size_t>(ccw(corner))];
      if (v != id) consider(v);
    });
    if (best.id == from) return best;
  }
}

void Regular2::prefetch(SiteId id, Ahead what) const {
  const Triangulation2& t = triangulation_;
  if (what == Ahead::site) return geom::prefetch(&t.sites[id]);
  const Triangulation2::Side at = t.sites[id].at;
  if (!at.valid()) return;
  const Triangulation2::Simplex& here = t.simplices[at.simplex()];
  if (what == Ahead::corner) return geom::prefetch(&here);
  const auto load_around = [&](const Triangulation2::Simplex& simplex) {
    for (std::size_t k = 0; k < 3; ++k) {
      geom::prefetch(&t.simplices[simplex.mate[k].simplex()]);
      geom::prefetch(&t.sites[simplex.corner[k]]);
    }
  };
  if (!t.is_live(at.simplex())) return;
  if (what == Ahead::around) return load_around(here);
  if (t.is_hidden(id)) return;
  for (const Triangulation2::Side side : here.mate) {
    if (side.valid() && t.is_live(side.simplex())) load_around(t.simplices[side.simplex()]);
  }
}

void Regular2::link(SiteId id, std::vector<SiteId>& out) const {
  out.clear();
  ensure(contains(id), "link of a site that is not in the triangulation");
  if (is_hidden(id)) return;
  visit_star(
      id, [&](SimplexId t, int corner) { out.push_back(corners(t)[static_cast<std::size_t>(ccw(corner))]); });
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
  for (const Triangulation2::Simplex& t : triangulation_.simplices) {
    if (t.corner[0].valid()) live.push_back(smallest_first(t.corner));
  }
  return live;
}

}  // namespace geom
