#include <optional>
#include <utility>

#include "geom/check.h"
#include "geom/pencil.h"
#include "geom/regular3.h"
#include "geom/regular3_corners.h"

namespace geom {

// Removal of p. Let T be the triangulation before and T' after it; both are unique, weights being perturbed.
//
// 1. A tetrahedron of T without corner p has an orthosphere that excludes all sites, so it is in T' as well:
// T' differs
//    from T only in the hole, the star of p.
// 2. A corner of T' in the closed hole is either a corner of T, hence on the hole's boundary (the star has no
// other
//    corner inside than p): a site of the link; or hidden in T, with a witness in the star. (A hidden site
//    whose witness survives stays hidden.) These are the candidates.
// 3. So let a facet abc of T' have the hole on its positive side. One tetrahedron abcd of T' lies there, d is
// a candidate,
//    and its orthosphere excludes all other candidates. The orthospheres through abc form a pencil, and their
//    parts on the positive side grow with it; hence among the candidates strictly on the positive side d is
//    the one whose orthosphere excludes the others, and running through them, replacing the best by any that
//    lies in its orthosphere, ends with d.
//
// Beginning with the facets of the link, the hole is thus wrapped facet by facet, and what fills it are the
// tetrahedra of T', exposed hidden sites included. Facets met from both sides are closed.

namespace {

/// Step 3: in doubles, in twofold precision where these cannot tell (spheres: all sites near one
/// orthosphere), exactly where that cannot.
class ApexSearch {
 public:
  ApexSearch(const RankedPoint3& a, const RankedPoint3& b, const RankedPoint3& c)
      : a_(a), b_(b), c_(c), coarse_(*a.point, *b.point, *c.point) {}

  /// Makes e the best so far if it is; says whether.
  bool offer(const RankedPoint3& e) {
    const auto place = coarse_.place(*e.point);
    const int side = coarse_.side(place);
    if (side < 0) return false;
    if (best_.point == nullptr) {
      if (side == 0 && !before(e)) return false;
    } else {
      const int power_side = coarse_.power_side(best_place_, place);
      if (power_side > 0) return false;
      if ((power_side == 0 || side == 0) && !improves(e)) return false;
    }
    best_ = e;
    best_place_ = place;
    best_fine_place_.reset();
    return true;
  }

 private:
  bool before(const RankedPoint3& e) const {
    return orient3(a_.point->position, b_.point->position, c_.point->position, e.point->position) > 0;
  }

  bool improves(const RankedPoint3& e) {
    if (!fine_) fine_.emplace(*a_.point, *b_.point, *c_.point);
    if (!best_fine_place_) best_fine_place_ = fine_->place(*best_.point);
    const auto place = fine_->place(*e.point);
    const int side = fine_->side(place);
    if (side < 0) return false;
    const int power_side = fine_->power_side(*best_fine_place_, place);
    if (power_side > 0) return false;
    if (power_side < 0 && side > 0) return true;
    return conflicts3(a_, b_, c_, best_, e) && before(e);
  }

  RankedPoint3 a_, b_, c_, best_{nullptr, 0};
  Pencil<double> coarse_;
  Pencil<double>::Place best_place_{};
  std::optional<Pencil<DoubleDouble>> fine_;  // made when first wanted
  std::optional<Pencil<DoubleDouble>::Place> best_fine_place_;
};

}  // namespace

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
  for (const CellId t : destroyed_) {
    const int i = corner_of(t, p);
    const auto [a, b, c] = facet_corners(cells_[t].corner, i);
    for (const SiteId v : {a, b, c}) {
      if (site(v).mark == seen) continue;
      site(v).mark = seen;
      candidates_.push_back(v);
    }
    matcher_.find_or_insert(a, b, c, static_cast<std::int32_t>(open_.size()));
    open_.push_back({a, b, c, cells_[t].mate[i]});
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
    const Cell corner = {base.a, base.b, base.c, d};
    const CellId t = create(corner);
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
