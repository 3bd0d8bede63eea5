// Insertion: the triangles whose circle the new site conflicts with form a cavity, star-shaped about it; the
// site is joined to the cavity's rim.
//
//      +-------+            +-------+
//     / \     / \          /  \   /  \        cavity: 4 triangles
//    /   \ . /   \        /    \ /    \       rim: 6 corners, counterclockwise
//   +-----+-----+   ->   +------e------+      star: 6 triangles (e, rim[k], rim[k + 1])
//    \   / \   /          \    / \    /
//     \ /   \ /            \  /   \  /
//      +-----+              +-----+

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/regular/regular2.h"

namespace geom {

Regular2::Change Regular2::insert(SiteId id, const WeightedPoint2& point, SimplexId hint) {
  begin_change();
  admit(id, point);
  insert_visible_or_hide(id, hint);
  return change();
}

void Regular2::begin_change() {
  destroyed_.clear();
  created_.clear();
  hidden_.clear();
  exposed_.clear();
}

void Regular2::insert_visible_or_hide(SiteId e, SimplexId hint) {
  const bool usable = hint.valid() && hint.index() < simplices_.size() && is_live(hint);
  SimplexId start = usable ? hint : recent_;
  if (!usable || !in_conflict(simplices_[start], e, 0)) {
    start = locate(e, start);
    // A site is hidden iff it is above the lower hull where it is: iff the triangle around it says so.
    if (!in_conflict(simplices_[start], e, 0)) {
      hide(e, start);
      hidden_.push_back(e);
      return;
    }
  }
  dig_cavity(e, start);
  star_cavity(e);
}

/// The filter asks the center; see set_dual() for its tolerance. A periodic copy nearer than the right one
/// can only make a non-conflict a conflict, when the cavity would meet its own copy: dig_cavity() rejects
/// that.
inline bool Regular2::in_conflict(const Simplex& t, SiteId e, int corner) const {
  const Site& x = sites_[e];
  const double dx = torus_.shortest_x(x.x - t.center_x), dy = torus_.shortest_y(x.y - t.center_y);
  const double q = dx * dx + dy * dy, power = q - x.weight - t.radius2;
  const double tolerance = t.tolerance * (q + std::abs(t.radius2) + weight_allowance_);
  if (power > tolerance) return false;
  if (power < -tolerance) return true;
  return in_conflict_exactly(t, e, corner);
}

/// Finds the cavity depth first, crossing the sides of each triangle counterclockwise, so that its rim comes
/// out counterclockwise too. Throws, with nothing modified, if the rim is not within half a period of e.
void Regular2::dig_cavity(SiteId e, SimplexId start) {
  star_.clear();
  rim_.clear();
  beyond_.clear();
  pending_.clear();
  ++mark_;
  simplices_[start].mark = mark_;
  star_.push_back(start);
  for (int k = 2; k >= 0; --k) pending_.push_back(Side(start, k));
  const Site& origin = sites_[e];
  while (!pending_.empty()) {
    const Side from = pending_.back();
    pending_.pop_back();
    const Simplex& inside = simplices_[from.simplex()];
    const Side across = inside.mate[static_cast<std::size_t>(from.corner())];
    Simplex& t = simplices_[across.simplex()];
    if (t.mark == mark_) continue;
    if (in_conflict(t, e, next(across.corner()))) {
      t.mark = mark_;
      star_.push_back(across.simplex());
      pending_.push_back(Side(across.simplex(), previous(across.corner())));
      pending_.push_back(Side(across.simplex(), next(across.corner())));
    } else {
      rim_.push_back(seen_from(origin, inside.corner[static_cast<std::size_t>(next(from.corner()))]));
      beyond_.push_back(across);
    }
  }
  bool proper = rim_.size() >= 3;
  for (std::size_t k = 0; k < rim_.size() && proper; ++k) {
    const Corner &a = rim_[k], &b = rim_[k + 1 < rim_.size() ? k + 1 : 0];
    const Side side = beyond_[k];  // there the edge runs from b to a
    proper = torus_.is_short(a.x, a.y) && torus_.is_short(b.x - a.x, b.y - a.y) &&
             simplices_[side.simplex()].corner[static_cast<std::size_t>(next(side.corner()))] == b.id;
  }
  require(proper, "too few samples, or too clustered: they leave a gap of about half a period");
}

void Regular2::star_cavity(SiteId e) {
  displaced_.clear();
  released_.clear();
  // A disk of t triangles with b corners on its rim has (t - b + 2) / 2 corners inside.
  if (star_.size() + 2 != rim_.size()) release_corners_of_cavity();
  for (const SimplexId t : star_) {
    if (simplices_[t].first_hidden.valid()) take_hidden_of(simplices_[t]);
    destroy(t);
  }
  const Corner center{0, 0, sites_[e].weight, e};
  SimplexId first, before;
  for (std::size_t k = 0; k < rim_.size(); ++k) {
    const SimplexId t = create(center, rim_[k], rim_[k + 1 < rim_.size() ? k + 1 : 0]);
    glue(Side(t, 0), beyond_[k]);
    if (k == 0)
      first = t;
    else
      glue(Side(before, 1), Side(t, 2));
    before = t;
  }
  glue(Side(before, 1), Side(first, 2));
  if (!displaced_.empty() || !released_.empty()) settle_displaced();
}

/// Takes their place from all corners of the cavity; those on the rim get a new one with the star.
void Regular2::release_corners_of_cavity() {
  for (const SimplexId t : star_) {
    for (const SiteId v : simplices_[t].corner) {
      if (!sites_[v].at.valid()) continue;
      sites_[v].at = Side();
      released_.push_back(v);
    }
  }
}

void Regular2::settle_displaced() {
  for (const SiteId v : released_) {
    if (sites_[v].at.valid()) continue;
    hidden_.push_back(v);
    displaced_.push_back(v);
  }
  for (const SiteId v : displaced_) hide(v, locate(v, recent_));
}

// --- hidden sites --------------------------------------------------------------------------------

void Regular2::hide(SiteId id, SimplexId witness) {
  sites_[id].at = Side(witness, 0);
  sites_[id].next_hidden = simplices_[witness].first_hidden;
  simplices_[witness].first_hidden = id;
}

void Regular2::unlink_hidden(SiteId id) {
  SiteId* link = &simplices_[sites_[id].at.simplex()].first_hidden;
  while (*link != id) link = &sites_[*link].next_hidden;
  *link = sites_[id].next_hidden;
  sites_[id].next_hidden = not_hidden;
}

void Regular2::take_hidden_of(const Simplex& t) {
  for (SiteId v = t.first_hidden; v.valid();) {
    Site& s = sites_[v];
    displaced_.push_back(v);
    v = s.next_hidden;
    s.at = Side();
    s.next_hidden = not_hidden;
  }
}

}  // namespace geom
