#include <utility>

#include "geom/check.h"
#include "geom/regular/apex_search.h"
#include "geom/regular/regular3.h"
#include "geom/regular/regular3_corners.h"

namespace geom {

// Removal of p. Let T be the triangulation before and T' after it; both are unique, weights being perturbed.
//
// - A tetrahedron of T without corner p has an orthosphere that excludes all sites, so it is in T' as well:
//   T' differs from T only in the hole, the star of p.
// - A corner of T' in the closed hole is either a corner of T, hence on the hole's boundary (the star has no
//   other corner inside than p): a site of the link; or hidden in T, with a witness in the star. (A hidden
//   site whose witness survives stays hidden.) These are the candidates.
// - So let a facet of T' have the hole on its positive side. One tetrahedron of T' lies there; its fourth
//   corner is a candidate and its orthosphere excludes all others: it is the one that ApexSearch finds.
//
// Beginning with the facets of the link, the hole is thus wrapped facet by facet, and what fills it are the
// tetrahedra of T', exposed hidden sites included. Facets met from both sides are closed.

Regular3::Change Regular3::remove(SiteId id) {
  ensure(contains(id), "regular3: the site to remove is not in the triangulation");
  begin_change();
  if (is_hidden(id)) {
    unlink_hidden(id);
    site(id) = Site();
    return finish_change();
  }
  open_hole(id);
  fill_hole();
  site(id) = Site();
  for (const SiteId h : displaced_) {
    if (site(h).state == State::hidden) hide(h, locate(position(h), created_.front()));
  }
  return finish_change();
}

/// Makes the star of p the destroyed, its outer facets the open ones and lists the candidates.
void Regular3::open_hole(SiteId p) {
  collect_star(p, destroyed_);
  const std::uint32_t seen = next_mark();
  matcher_.clear();
  for (const SimplexId t : destroyed_) {
    const int i = corner_of(t, p);
    const auto [a, b, c] = facet_corners(simplices_[t].corner, i);
    for (const SiteId v : {a, b, c}) {
      if (site(v).mark == seen) continue;
      site(v).mark = seen;
      candidates_.push_back(v);
    }
    matcher_.find_or_insert(a, b, c, static_cast<std::int32_t>(open_.size()));
    open_.push_back({a, b, c, simplices_[t].mate[i]});
    take_hidden_of(t);
  }
  candidates_.insert(candidates_.end(), displaced_.begin(), displaced_.end());
}

void Regular3::fill_hole() {
  for (std::size_t k = 0; k < open_.size(); ++k) {
    const OpenFacet base = open_[k];
    if (base.closed) continue;
    const SiteId d = apex(base);
    if (site(d).state == State::hidden) {
      site(d).state = State::visible;
      exposed_.push_back(d);
    }
    const Simplex corner = {base.a, base.b, base.c, d};
    const SimplexId t = create(corner);
    glue({t, 3}, base.outer);
    for (int i = 0; i < 3; ++i) {
      const auto [a, b, c] = facet_corners(corner, i);
      const std::int32_t twin = matcher_.find_or_insert(a, b, c, static_cast<std::int32_t>(open_.size()));
      if (twin < 0) {
        open_.push_back({a, c, b, Facet(t, i)});  // turned: what is left of the hole is across
      } else {
        OpenFacet& facing = open_[twin];
        ensure(!facing.closed, "regular3: three tetrahedra meet in one facet");
        facing.closed = true;
        glue({t, i}, facing.outer);
      }
    }
  }
}

/// The fourth corner of the tetrahedron on the positive side of a facet of the hole.
SiteId Regular3::apex(const OpenFacet& facet) const {
  auto [a, b, c] = std::array{facet.a, facet.b, facet.c};
  for (int turn = 0; turn < 2 && is_guard(a); ++turn) {  // differences from a near point keep their digits
    a = std::exchange(b, std::exchange(c, a));
  }
  ApexSearch search(ranked(a), ranked(b), ranked(c));
  SiteId best;
  for (const SiteId e : candidates_) {
    if (e == facet.a || e == facet.b || e == facet.c) continue;
    if (search.offer(ranked(e))) best = e;
  }
  ensure(best != SiteId(), "regular3: no site closes a facet of the hole");
  return best;
}

}  // namespace geom
