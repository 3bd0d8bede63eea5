#include "geom/regular/regular3.h"

#include "geom/check.h"

namespace geom {

Regular3::Change Regular3::insert(SiteId id, const WeightedPoint3& point, SiteId hint) {
  triangulation_.change.clear();
  insertion_.insert(triangulation_, id, point, hint);
  return triangulation_.finish_change();
}

Regular3::Change Regular3::remove(SiteId id) {
  ensure(contains(id), "regular3: the site to remove is not in the triangulation");
  triangulation_.change.clear();
  removal_.remove(triangulation_, id);
  return triangulation_.finish_change();
}

void Regular3::link(SiteId id, std::vector<SiteId>& out) const {
  out.clear();
  ensure(contains(id), "link of a site that is not in the triangulation");
  if (is_hidden(id)) return;
  const Triangulation3& t = triangulation_;
  star_.clear();
  t.collect_star(id, star_);
  const std::uint32_t seen = t.next_mark();
  t.site(id).mark = seen;
  for (const SimplexId id : star_) {
    for (const SiteId v : t.simplices[id].corner) {
      if (t.site(v).mark == seen) continue;
      t.site(v).mark = seen;
      if (v.valid()) out.push_back(v);
    }
  }
}

void Regular3::link_and_hidden(SiteId id, std::vector<SiteId>& out) const {
  link(id, out);
  if (is_hidden(id)) return;
  for (const SimplexId t : star_) append_hidden(triangulation_, t, out);
}

std::vector<Triangulation3::Simplex> Regular3::simplices() const {
  std::vector<Simplex> live;
  for (const Triangulation3::Tetrahedron& t : triangulation_.simplices) {
    if (t.corner[0] != SiteId()) live.push_back(t.corner);
  }
  return live;
}

}  // namespace geom
