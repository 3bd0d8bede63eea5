#include "geom/regular/removal2.h"

#include <algorithm>

#include "geom/check.h"

namespace geom {
namespace {

/// After several changes in one: each triangle once, and only those that are there now as created.
void normalize_change(Triangulation2& t) {
  for (std::vector<SimplexId>* list : {&t.change.destroyed, &t.change.created}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  std::erase_if(t.change.created, [&](SimplexId id) { return !t.is_live(id); });
}

}  // namespace

void Removal2::remove(Triangulation2& t, SiteId id, Insertion2& insertion) {
  if (t.is_hidden(id)) {
    unhide(t, id);
    t.sites[id].at = Triangulation2::Side();
    return;
  }
  open_hole(t, id);
  plan_.plan(hole_.rim);
  require_short_chords(t);
  fill_hole(t, id);
  if (!orphans_.empty()) expose_orphans(t, insertion);
}

void Removal2::open_hole(const Triangulation2& t, SiteId p) {
  hole_.clear();
  const Triangulation2::Site& origin = t.sites[p];
  t.visit_star(p, [&](SimplexId id, int corner) {
    const Triangulation2::Simplex& simplex = t.simplices[id];
    hole_.triangles.push_back(id);
    hole_.rim.push_back(t.seen_from(origin, simplex.corner[static_cast<std::size_t>(ccw(corner))]));
    hole_.beyond.push_back(simplex.mate[static_cast<std::size_t>(corner)]);
  });
}

void Removal2::require_short_chords(const Triangulation2& t) const {
  for (const HolePlan2::Chain& chain : plan_.chains().subspan(1)) {
    const SeenSite &a = hole_.rim[static_cast<std::size_t>(chain.first)],
                   &b = hole_.rim[static_cast<std::size_t>(chain.last)];
    require(t.torus.is_short(b.x - a.x, b.y - a.y),
            "too few samples, or too clustered: without one there is a gap of about half a period");
  }
}

/// Children before parents.
void Removal2::fill_hole(Triangulation2& t, SiteId p) {
  using Side = Triangulation2::Side;
  hole_.destroy(t, orphans_);
  t.sites[p].at = Side();
  const std::span<const HolePlan2::Chain> chains = plan_.chains();
  closing_.resize(chains.size());
  for (std::size_t k = chains.size(); k-- > 0;) {
    const HolePlan2::Chain& chain = chains[k];
    const auto first = static_cast<std::size_t>(chain.first), middle = static_cast<std::size_t>(chain.apex);
    const SimplexId id =
        t.create(hole_.rim[static_cast<std::size_t>(chain.last)], hole_.rim[first], hole_.rim[middle]);
    const auto side_of = [&](std::int32_t child, std::size_t edge) {
      return child >= 0 ? closing_[static_cast<std::size_t>(child)] : hole_.beyond[edge];
    };
    t.glue(Side(id, 0), side_of(chain.child[0], first));
    t.glue(Side(id, 1), side_of(chain.child[1], middle));
    closing_[k] = Side(id, 2);
  }
  t.glue(closing_.front(), hole_.beyond.back());
}

/// Inserts again what the removed site's triangles were hiding. One may swallow another, so who is exposed is
/// known at the end.
void Removal2::expose_orphans(Triangulation2& t, Insertion2& insertion) {
  std::sort(orphans_.begin(), orphans_.end());
  for (const SiteId v : orphans_) insertion.insert(t, v, t.recent);
  t.change.hidden.clear();
  for (const SiteId v : orphans_) {
    if (!t.is_hidden(v)) t.change.exposed.push_back(v);
  }
  if (!t.change.exposed.empty()) normalize_change(t);
}

}  // namespace geom
