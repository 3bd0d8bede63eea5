#include "geom/regular/disk2.h"

namespace geom {
namespace {

void take_hidden(Triangulation2& t, const Triangulation2::Simplex& witness, std::vector<SiteId>& displaced) {
  for (SiteId v = witness.first_hidden; v.valid();) {
    Triangulation2::Site& s = t.sites[v];
    displaced.push_back(v);
    v = s.next_hidden;
    s.at = Triangulation2::Side();
    s.next_hidden = Triangulation2::not_hidden;
  }
}

}  // namespace

void Disk2::destroy(Triangulation2& t, std::vector<SiteId>& displaced) const {
  displaced.clear();
  for (const SimplexId id : triangles) {
    if (t.simplices[id].first_hidden.valid()) take_hidden(t, t.simplices[id], displaced);
    t.destroy(id);
  }
}

void hide(Triangulation2& t, SiteId id, SimplexId witness) {
  t.sites[id].at = Triangulation2::Side(witness, 0);
  t.sites[id].next_hidden = t.simplices[witness].first_hidden;
  t.simplices[witness].first_hidden = id;
}

void unhide(Triangulation2& t, SiteId id) {
  SiteId* link = &t.simplices[t.sites[id].at.simplex()].first_hidden;
  while (*link != id) link = &t.sites[*link].next_hidden;
  *link = t.sites[id].next_hidden;
  t.sites[id].next_hidden = Triangulation2::not_hidden;
}

}  // namespace geom
