// The invariants of the regular triangulation in space.

#include "geom/check.h"
#include "geom/regular/triangulation3.h"

namespace geom {

namespace {

void check_simplex(const Triangulation3& m, SimplexId t) {
  const Triangulation3::Tetrahedron& here = m.simplices[t];
  ensure(m.orientation(here.corner) > 0, "regular3: a tetrahedron is not positively oriented");
  for (const SiteId v : here.corner) {
    ensure(is_guard(v) || m.contains(v), "regular3: a corner is not a site");
    ensure(m.site(v).state == Triangulation3::State::visible, "regular3: a corner is hidden");
  }
  for (int i = 0; i < 4; ++i) {
    const auto [a, b, c] = facet_corners(here.corner, i);
    const SimplexId next = here.mate[i].simplex();
    if (!next.valid()) {
      ensure(is_guard(a) && is_guard(b) && is_guard(c), "regular3: a facet of the hull is not of guards");
      continue;
    }
    const int j = here.mate[i].corner();
    ensure(m.simplices[next].mate[j] == TetrahedronFacet(t, i), "regular3: adjacency is not symmetric");
    for (const SiteId v : {a, b, c}) {
      const int k = corner_of(m.simplices[next].corner, v);
      ensure(k < 4 && k != j, "regular3: neighbours do not share their facet");
    }
    ensure(!m.in_conflict(t, m.simplices[next].corner[j]), "regular3: a facet is not locally regular");
  }
}

void check_site(const Triangulation3& m, SiteId id) {
  const Triangulation3::Site& s = m.site(id);
  if (s.state == Triangulation3::State::absent) return;
  const Triangulation3::Simplex& corner = m.simplices[s.simplex].corner;
  ensure(corner[0] != SiteId(), "regular3: a site refers to a freed tetrahedron");
  if (s.state == Triangulation3::State::visible) {
    ensure(corner_of(corner, id) < 4, "regular3: a site is no corner of its tetrahedron");
    return;
  }
  for (int i = 0; i < 4; ++i) {
    const auto [a, b, c] = facet_corners(corner, i);
    ensure(orient3(m.point(a).position, m.point(b).position, m.point(c).position, m.point(id).position) >= 0,
           "regular3: a hidden site is outside its witness");
  }
  ensure(!m.in_conflict(s.simplex, id), "regular3: a hidden site conflicts with its witness");
  SiteId h = m.simplices[s.simplex].first_hidden;
  while (h.valid() && h != id) h = m.site(h).next_hidden;
  ensure(h == id, "regular3: a witness does not list its hidden site");
}

}  // namespace

void check(const Triangulation3& m) {
  std::size_t live = 0;
  for (SimplexId t(0); t < m.simplices.next_id(); ++t.value) {
    if (m.simplices[t].corner[0] == SiteId()) continue;
    ++live;
    check_simplex(m, t);
  }
  ensure(live + m.free.size() == m.simplices.size(), "regular3: a tetrahedron is neither live nor free");
  for (int k = 0; k < guard_count; ++k) check_site(m, guard(k));
  for (SiteId id(0); m.slot(id) < m.sites.size(); ++id.value) check_site(m, id);
}

}  // namespace geom
