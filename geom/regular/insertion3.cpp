#include "geom/regular/insertion3.h"

#include <cmath>

#include "geom/check.h"

namespace geom {

namespace {

/// Stores the point of a new site, still absent.
void admit(Triangulation3& t, SiteId id, const WeightedPoint3& point) {
  ensure(id.valid() && id.value < INT32_MAX - 2 * guard_count, "regular3: the id of a site is out of range");
  ensure(!t.contains(id), "regular3: the id of a new site is in use");
  require(point.position.allFinite() && std::isfinite(point.weight),
          "a site has a coordinate that is not finite");
  require(t.box.contains(point.position), "a site lies outside the box of the triangulation");
  if (t.slot(id) >= t.sites.size()) {
    t.sites.resize(t.slot(id) + 1);
    t.points.resize(t.slot(id) + 1);
  }
  t.points[t.slot(id)] = point;
}

}  // namespace

void Insertion3::insert(Triangulation3& t, SiteId id, const WeightedPoint3& point, SiteId hint) {
  admit(t, id, point);
  const SimplexId start =
      t.locate(point.position, t.contains(hint) && hint != id ? t.site(hint).simplex : t.recent);
  if (!t.in_conflict(start, id)) {
    hide(t, id, start);
    t.change.hidden.push_back(id);
    return;
  }
  t.site(id).state = Triangulation3::State::visible;
  dig_cavity(t, start, id);
  star_cavity(t, id);
  hide_swallowed(t);
}

/// Floods the tetrahedra in conflict with p from one of them: they become the destroyed, in breadth-first
/// order, and the facets around them the boundary.
void Insertion3::dig_cavity(Triangulation3& t, SimplexId start, SiteId p) {
  boundary_.clear();
  const std::uint32_t clear = t.next_mark(), conflicting = t.next_mark();
  t.simplices[start].mark = conflicting;
  t.change.destroyed.push_back(start);
  for (std::size_t k = 0; k < t.change.destroyed.size(); ++k) {
    const Triangulation3::Tetrahedron& here = t.simplices[t.change.destroyed[k]];
    for (int i = 0; i < 4; ++i) {
      const SimplexId next = here.mate[i].simplex();
      if (next.valid()) {
        std::uint32_t& mark = t.simplices[next].mark;
        if (mark == conflicting) continue;
        if (mark != clear) {
          mark = t.in_conflict(next, p) ? conflicting : clear;
          if (mark == conflicting) {
            t.change.destroyed.push_back(next);
            continue;
          }
        }
      }
      boundary_.push_back({t.change.destroyed[k], i});
    }
  }
}

/// Joins each facet of the boundary to p. Two of the new tetrahedra meet in the facet of p and a boundary
/// edge.
void Insertion3::star_cavity(Triangulation3& t, SiteId p) {
  matcher_.clear();
  for (const TetrahedronFacet inner : boundary_) {
    Triangulation3::Simplex corner = t.simplices[inner.simplex()].corner;
    corner[inner.corner()] = p;
    const SimplexId id = t.create(corner);
    t.glue({id, inner.corner()}, t.simplices[inner.simplex()].mate[inner.corner()]);
    for (int i = 0; i < 4; ++i) {
      if (i == inner.corner()) continue;
      const auto [a, b, c] = facet_corners(corner, i);
      const TetrahedronFacet twin(matcher_.find_or_insert(a, b, c, TetrahedronFacet(id, i).code()));
      if (twin.valid()) t.glue({id, i}, twin);
    }
  }
}

/// Finds witnesses in or about the new star for the sites that lost theirs and for the corners inside the
/// cavity. The latter still refer to a destroyed tetrahedron, the corners on the boundary to a new one.
void Insertion3::hide_swallowed(Triangulation3& t) {
  displaced_.clear();
  const std::uint32_t conflicting = t.simplices[t.change.destroyed.front()].mark;
  for (const SimplexId id : t.change.destroyed) {
    append_hidden(t, id, displaced_);
    for (const SiteId v : t.simplices[id].corner) {
      Triangulation3::Site& corner = t.site(v);
      if (corner.state != Triangulation3::State::visible || t.simplices[corner.simplex].mark != conflicting)
        continue;
      corner.state = Triangulation3::State::hidden;
      t.change.hidden.push_back(v);
    }
  }
  displaced_.insert(displaced_.end(), t.change.hidden.begin(), t.change.hidden.end());
  for (const SiteId h : displaced_) hide(t, h, t.locate(t.point(h).position, t.change.created.front()));
}

}  // namespace geom
