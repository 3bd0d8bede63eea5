#include "geom/regular/removal3.h"

#include <utility>

#include "geom/check.h"
#include "geom/regular/apex_search.h"

namespace geom {

void Removal3::remove(Triangulation3& t, SiteId id) {
  if (t.site(id).state == Triangulation3::State::hidden) {
    unhide(t, id);
    t.site(id) = Triangulation3::Site();
    return;
  }
  open_hole(t, id);
  fill_hole(t);
  t.site(id) = Triangulation3::Site();
  for (const SiteId h : displaced_) {
    if (t.site(h).state == Triangulation3::State::hidden)
      hide(t, h, t.locate(t.point(h).position, t.change.created.front()));
  }
}

/// Makes the star of p the destroyed, its outer facets the open ones and lists the candidates.
void Removal3::open_hole(Triangulation3& t, SiteId p) {
  open_.clear();
  candidates_.clear();
  displaced_.clear();
  t.collect_star(p, t.change.destroyed);
  const std::uint32_t seen = t.next_mark();
  matcher_.clear();
  for (const SimplexId id : t.change.destroyed) {
    const int i = corner_of(t.simplices[id].corner, p);
    const auto [a, b, c] = facet_corners(t.simplices[id].corner, i);
    for (const SiteId v : {a, b, c}) {
      if (t.site(v).mark == seen) continue;
      t.site(v).mark = seen;
      candidates_.push_back(v);
    }
    matcher_.find_or_insert(a, b, c, static_cast<std::int32_t>(open_.size()));
    open_.push_back({a, b, c, t.simplices[id].mate[i]});
    append_hidden(t, id, displaced_);
  }
  candidates_.insert(candidates_.end(), displaced_.begin(), displaced_.end());
}

void Removal3::fill_hole(Triangulation3& t) {
  for (std::size_t k = 0; k < open_.size(); ++k) {
    const OpenFacet base = open_[k];
    if (base.closed) continue;
    const SiteId d = apex(t, base);
    if (t.site(d).state == Triangulation3::State::hidden) {
      t.site(d).state = Triangulation3::State::visible;
      t.change.exposed.push_back(d);
    }
    const Triangulation3::Simplex corner = {base.a, base.b, base.c, d};
    const SimplexId id = t.create(corner);
    t.glue({id, 3}, base.outer);
    for (int i = 0; i < 3; ++i) {
      const auto [a, b, c] = facet_corners(corner, i);
      const std::int32_t twin = matcher_.find_or_insert(a, b, c, static_cast<std::int32_t>(open_.size()));
      if (twin < 0) {
        open_.push_back({a, c, b, TetrahedronFacet(id, i)});  // turned: what is left of the hole is across
      } else {
        OpenFacet& facing = open_[twin];
        ensure(!facing.closed, "regular3: three tetrahedra meet in one facet");
        facing.closed = true;
        t.glue({id, i}, facing.outer);
      }
    }
  }
}

/// The fourth corner of the tetrahedron on the positive side of a facet of the hole.
SiteId Removal3::apex(const Triangulation3& t, const OpenFacet& facet) const {
  auto [a, b, c] = std::array{facet.a, facet.b, facet.c};
  for (int turn = 0; turn < 2 && is_guard(a); ++turn) {  // differences from a near point keep their digits
    a = std::exchange(b, std::exchange(c, a));
  }
  ApexSearch search(t.ranked(a), t.ranked(b), t.ranked(c));
  SiteId best;
  for (const SiteId e : candidates_) {
    if (e == facet.a || e == facet.b || e == facet.c) continue;
    if (search.offer(t.ranked(e))) best = e;
  }
  ensure(best != SiteId(), "regular3: no site closes a facet of the hole");
  return best;
}

}  // namespace geom
