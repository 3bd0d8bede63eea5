#include "geom/regular/insertion2.h"

#include "geom/check.h"

namespace geom {

void Insertion2::insert(Triangulation2& t, SiteId e, SimplexId hint) {
  const bool usable = hint.valid() && hint.index() < t.simplices.size() && t.is_live(hint);
  SimplexId start = usable ? hint : t.recent;
  if (!usable || !t.in_conflict(t.simplices[start], e, 0)) {
    start = t.locate(e, start);
    // A site is hidden iff it is above the lower hull where it is: iff the triangle around it says so.
    if (!t.in_conflict(t.simplices[start], e, 0)) {
      hide(t, e, start);
      t.change.hidden.push_back(e);
      return;
    }
  }
  dig_cavity(t, e, start);
  require_short_edges(t);
  star_cavity(t, e);
}

/// Finds the cavity depth first, crossing the sides of each triangle counterclockwise, so that its rim comes
/// out counterclockwise too.
void Insertion2::dig_cavity(Triangulation2& t, SiteId e, SimplexId start) {
  cavity_.clear();
  pending_.clear();
  ++mark_;
  t.simplices[start].mark = mark_;
  cavity_.triangles.push_back(start);
  for (int k = 2; k >= 0; --k) pending_.push_back({start, k});
  const Triangulation2::Site& origin = t.sites[e];
  while (!pending_.empty()) {
    const Triangulation2::Side from = pending_.back();
    pending_.pop_back();
    const Triangulation2::Simplex& inside = t.simplices[from.simplex()];
    const Triangulation2::Side across = inside.mate[static_cast<std::size_t>(from.corner())];
    Triangulation2::Simplex& beyond = t.simplices[across.simplex()];
    if (beyond.mark == mark_) continue;
    if (t.in_conflict(beyond, e, ccw(across.corner()))) {
      beyond.mark = mark_;
      cavity_.triangles.push_back(across.simplex());
      pending_.push_back({across.simplex(), cw(across.corner())});
      pending_.push_back({across.simplex(), ccw(across.corner())});
    } else {
      const SiteId corner = inside.corner[static_cast<std::size_t>(ccw(from.corner()))];
      cavity_.rim.push_back(t.seen_from(origin, corner));
      cavity_.beyond.push_back(across);
    }
  }
}

/// The filter of in_conflict() may take a nearer copy of e for e; then the cavity meets its own copy here.
void Insertion2::require_short_edges(const Triangulation2& t) const {
  bool proper = cavity_.rim.size() >= 3;
  for (std::size_t k = 0; k < cavity_.rim.size() && proper; ++k) {
    const SeenSite &a = cavity_.rim[k], &b = cavity_.rim[cavity_.next(k)];
    const Triangulation2::Side side = cavity_.beyond[k];  // there the edge runs from b to a
    proper = t.torus.is_short(a.x, a.y) && t.torus.is_short(b.x - a.x, b.y - a.y) &&
             t.simplices[side.simplex()].corner[static_cast<std::size_t>(ccw(side.corner()))] == b.id;
  }
  require(proper, "too few samples, or too clustered: they leave a gap of about half a period");
}

void Insertion2::star_cavity(Triangulation2& t, SiteId e) {
  using Side = Triangulation2::Side;
  released_.clear();
  // A disk of t triangles with b corners on its rim has (t - b + 2) / 2 corners inside.
  if (cavity_.triangles.size() + 2 != cavity_.rim.size()) release_corners(t);
  cavity_.destroy(t, displaced_);
  const SeenSite center{0, 0, t.sites[e].weight, e};
  SimplexId first, before;
  for (std::size_t k = 0; k < cavity_.rim.size(); ++k) {
    const SimplexId star = t.create(center, cavity_.rim[k], cavity_.rim[cavity_.next(k)]);
    t.glue(Side(star, 0), cavity_.beyond[k]);
    if (k == 0)
      first = star;
    else
      t.glue(Side(before, 1), Side(star, 2));
    before = star;
  }
  t.glue(Side(before, 1), Side(first, 2));
  if (!displaced_.empty() || !released_.empty()) settle_displaced(t);
}

/// Takes their place from all corners of the cavity; those on the rim get a new one with the star.
void Insertion2::release_corners(Triangulation2& t) {
  for (const SimplexId id : cavity_.triangles) {
    for (const SiteId v : t.simplices[id].corner) {
      if (!t.sites[v].at.valid()) continue;
      t.sites[v].at = Triangulation2::Side();
      released_.push_back(v);
    }
  }
}

void Insertion2::settle_displaced(Triangulation2& t) {
  for (const SiteId v : released_) {
    if (t.sites[v].at.valid()) continue;
    t.change.hidden.push_back(v);
    displaced_.push_back(v);
  }
  for (const SiteId v : displaced_) hide(t, v, t.locate(v, t.recent));
}

}  // namespace geom
