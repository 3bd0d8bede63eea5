#include <cmath>

#include "geom/check.h"
#include "geom/regular/regular3.h"
#include "geom/regular/regular3_corners.h"

namespace geom {

// Insertion of p (Bowyer, Watson). The tetrahedra whose orthosphere contains p are those that die; they form
// the cavity, which is star-shaped as seen from p: each of its facets sees p on its inner side, strictly,
// because perturbed weights leave no flat tetrahedron in the result. Joining the facets to p fills it.
//
//        .-------.                .-------.
//       /|\     /|               /  \   / |      corners that were only inside the cavity
//      / | \ p / |              /    \ /  |      are hidden by p: they lie in the new star
//     .--+--.-+--.      ->     .------p---.      and get their witnesses there
//      \ | / \ | /              \    / \  /
//       \|/   \|/                \  /   \/
//        '-----'                  '-----'
//
// p itself is hidden iff it is not in conflict with a tetrahedron that contains it: lifted to the paraboloid
// less the weight it lies above the lower hull there.

Regular3::Change Regular3::insert(SiteId id, const WeightedPoint3& point, SiteId hint) {
  admit(id, point);
  begin_change();
  const SimplexId start = locate(point.position, contains(hint) && hint != id ? site(hint).simplex : recent_);
  if (!in_conflict(start, id)) {
    hide(id, start);
    hidden_.push_back(id);
    return finish_change();
  }
  site(id).state = State::visible;
  dig_cavity(start, id);
  star_cavity(id);
  hide_swallowed();
  return finish_change();
}

/// Stores the point of a new site, still absent.
void Regular3::admit(SiteId id, const WeightedPoint3& point) {
  ensure(id.valid() && id.value < INT32_MAX - 2 * guard_count, "regular3: the id of a site is out of range");
  ensure(!contains(id), "regular3: the id of a new site is in use");
  require(point.position.allFinite() && std::isfinite(point.weight),
          "a site has a coordinate that is not finite");
  require(box_.contains(point.position), "a site lies outside the box of the triangulation");
  if (slot(id) >= sites_.size()) {
    sites_.resize(slot(id) + 1);
    points_.resize(slot(id) + 1);
  }
  points_[slot(id)] = point;
}

/// Floods the tetrahedra in conflict with p from one of them: they become the destroyed, in breadth-first
/// order, and the facets around them the boundary.
void Regular3::dig_cavity(SimplexId start, SiteId p) {
  const std::uint32_t clear = next_mark(), conflicting = next_mark();
  simplices_[start].mark = conflicting;
  destroyed_.push_back(start);
  for (std::size_t k = 0; k < destroyed_.size(); ++k) {
    const Tetrahedron& here = simplices_[destroyed_[k]];
    for (int i = 0; i < 4; ++i) {
      const SimplexId next = here.mate[i].simplex();
      if (next.valid()) {
        std::uint32_t& mark = simplices_[next].mark;
        if (mark == conflicting) continue;
        if (mark != clear) {
          mark = in_conflict(next, p) ? conflicting : clear;
          if (mark == conflicting) {
            destroyed_.push_back(next);
            continue;
          }
        }
      }
      boundary_.push_back({destroyed_[k], i});
    }
  }
}

/// Joins each facet of the boundary to p. Two of the new tetrahedra meet in the facet of p and a boundary
/// edge.
void Regular3::star_cavity(SiteId p) {
  matcher_.clear();
  for (const Facet inner : boundary_) {
    Simplex corner = simplices_[inner.simplex()].corner;
    corner[inner.corner()] = p;
    const SimplexId t = create(corner);
    glue({t, inner.corner()}, simplices_[inner.simplex()].mate[inner.corner()]);
    for (int i = 0; i < 4; ++i) {
      if (i == inner.corner()) continue;
      const auto [a, b, c] = facet_corners(corner, i);
      const Facet twin(matcher_.find_or_insert(a, b, c, Facet(t, i).code()));
      if (twin.valid()) glue({t, i}, twin);
    }
  }
}

/// Finds witnesses in or about the new star for the sites that lost theirs and for the corners inside the
/// cavity. The latter still refer to a destroyed tetrahedron, the corners on the boundary to a new one.
void Regular3::hide_swallowed() {
  const std::uint32_t conflicting = simplices_[destroyed_.front()].mark;
  for (const SimplexId t : destroyed_) {
    take_hidden_of(t);
    for (const SiteId v : simplices_[t].corner) {
      Site& corner = site(v);
      if (corner.state != State::visible || simplices_[corner.simplex].mark != conflicting) continue;
      corner.state = State::hidden;
      hidden_.push_back(v);
    }
  }
  displaced_.insert(displaced_.end(), hidden_.begin(), hidden_.end());
  for (const SiteId h : displaced_) hide(h, locate(position(h), created_.front()));
}

}  // namespace geom
