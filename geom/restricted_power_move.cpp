// A site moves: removal and insertion (paper, section 4.2) in one.
//
//      .-----.-----.          In a set that is nearly optimal a sample goes to a place nearby, and its new cell p' is
//     /  j  / \  k  \         bounded by the same neighbours on the same facets as the old one. Then the fragments
//    .-----.   .-----.        around keep their edges, and only their corners on the border of p move. That is so
//     \    | p |    /         for the fragment of j, with the share of p's old cell that continues it, if p' takes
//      '---'---'---'          exactly those corners that p had: all of the share, and none of j's own.
//
// Where it is not, the fragment and its share are united and cut again.

#include <algorithm>
#include <limits>

#include "geom/check.h"
#include "geom/restricted_power.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

// The rivals at the new place, p being out, and the heirs of the old cell: all others keep what they have. (The
// source knows how far the heirs reach without their shares.)
const RestrictedPower::Change& RestrictedPower::after_move(SiteId p, const WeightedPoint3& point) {
  settle_deferred(p, point);
  begin(p);
  admit(p, point);
  for (const FragmentId f : vacated_) assembly_.touch(store_.facet(f)).own = f;
  candidates_.clear();
  neighbours_.rivals(p, candidates_);
  candidates_.insert(candidates_.end(), division_.heirs().begin(), division_.heirs().end());
  std::ranges::sort(candidates_);
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  for (const CellDivision::Share& share : division_.shares())
    if (share.joins.valid()) store_.set_mark(share.joins, true);  // no prospect, but to be redrawn
  meet_rivals(p);
  for (const CellDivision::Share& share : division_.shares())
    if (share.joins.valid()) redraw(share.joins, share.polygon, p);
  for (const Prospect& prospect : prospects_) take_from(prospect, p);
  note_losses();
  take_new_shares(p);
  reach_[p] = -infinity;
  for (const CellAssembly::TouchedFacet& touched : assembly_.facets())
    reach_[p] = std::max(reach_[p], redraw_own(touched, p));

  assembly_.clear();
  finish();
  neighbours_.set_reach(p, reach_[p]);
  return change_;
}

/// Gives fragment f its share of p's old cell, and p what it wins of both.
void RestrictedPower::redraw(FragmentId f, const FacetPolygon& share, SiteId p) {
  Rival& rival = *std::ranges::lower_bound(rivals_, share.owner, {}, &Rival::site);
  rival.changed = true;
  store_.set_mark(f, false);
  const Seam seam = seam_of(f, share, p);
  if (keeps_its_edges(f, share, seam, rival.bisector)) return move_edge(f, seam.in_old, p, rival.bisector);
  unite(f, share, seam, union_);
  const Clip outcome =
      clipper_.classify(union_.facet, union_.owner, union_.corners, p, rival.bisector, beaten_);
  if (outcome == Clip::swallowed) {
    assembly_.win_on(union_.facet);
    return forget(f);
  }
  const std::span<const PolygonCorner> old = store_.corners(f);
  erase_circle_of(old[seam.in_old]);
  erase_circle_of(old[next_corner(seam.in_old, old.size())]);
  if (outcome == Clip::cut) cut_polygon(union_.facet, union_.owner, union_.corners, p, rival.bisector);
  commit(f, outcome == Clip::cut ? polygon_ : union_);
}

/// Does p, at its new place, take all of the share and no corner of f? What both make is convex and p takes
/// consecutive corners of it. The share has a corner beside its two on the old border, so if p takes those of the
/// share and neither of the two of f next to the border, it takes none of the others of f in between.
bool RestrictedPower::keeps_its_edges(FragmentId f, const FacetPolygon& share, const Seam& seam,
                                      const Bisector& b) const {
  const auto [q, g, fits] = seam;
  ensure(fits, "restricted power diagram: a share does not fit its neighbour");
  const std::span<const PolygonCorner> corners = store_.corners(f);
  const std::size_t n = corners.size(), m = share.corners.size();
  const SiteId p = corners[q].edge.site();
  const auto takes = [&](std::span<const PolygonCorner> of, std::size_t k) {
    return clipper_.beats_at(cell_corner(share.facet, share.owner, of, k), p, b);
  };
  if (takes(corners, previous_corner(q, n)) || takes(corners, next_corner(next_corner(q, n), n)))
    return false;
  for (std::size_t k = next_corner(next_corner(g, m), m); k != g; k = next_corner(k, m))
    if (!takes(share.corners, k)) return false;
  return true;
}

/// Moves the edge of f that borders p, which starts in that corner.
void RestrictedPower::move_edge(FragmentId f, std::size_t edge, SiteId p, const Bisector& b) {
  const std::span<PolygonCorner> corners = store_.corners_to_move(f);
  const FacetId t = store_.facet(f);
  const SiteId j = store_.site(f);
  PolygonCorner &start = corners[edge], &end = corners[next_corner(edge, corners.size())];
  const EdgeLabel before = corners[previous_corner(edge, corners.size())].edge;
  const std::array<RoundedPoint, 2> ends =
      assembly_.add_cut(t, {.rival = j, .leaving = before, .entering = end.edge}, p, b);
  start.point = ends[0];
  end.point = ends[1];
  move_circle(start);
  move_circle(end);
  store_.set_max_radius2(f, clipper_.bound_power(t, j, corners));
  change_.cut.push_back({j, t});
}

/// The shares of p's old cell that continue no fragment.
void RestrictedPower::take_new_shares(SiteId p) {
  for (auto& [joins, share] : division_.shares()) {
    if (joins.valid()) continue;
    const Bisector b = clipper_.bisector_of(share.owner, p);
    const Clip outcome = clipper_.classify(share.facet, share.owner, share.corners, p, b, beaten_);
    if (outcome == Clip::swallowed) {
      assembly_.win_on(share.facet);
      continue;
    }
    if (outcome == Clip::cut) cut_polygon(share.facet, share.owner, share.corners, p, b);
    touch_cell(share.owner);
    reach_[share.owner] =
        std::max(reach_[share.owner], commit(FragmentId(), outcome == Clip::cut ? polygon_ : share));
  }
}

/// p's fragment on a facet where it had or has one; returns the bound of its power.
double RestrictedPower::redraw_own(const CellAssembly::TouchedFacet& touched, SiteId p) {
  if (!touched.won) {
    forget(touched.own);
    return -infinity;
  }
  const bool stays_whole = touched.cuts < 0 && touched.own.valid() && store_.whole(touched.own);
  if (!stays_whole) {
    assembly_.assemble(touched, p, polygon_);
    if (!touched.own.valid()) return commit(FragmentId(), polygon_);
    if (!move_corners(touched.own)) {
      for (const PolygonCorner& corner : store_.corners(touched.own)) erase_circle_of(corner);
      return commit(touched.own, polygon_);
    }
  }
  change_.cut.push_back({p, touched.facet});
  std::array<PolygonCorner, 3> buffer;
  const double max_radius2 = clipper_.bound_power(touched.facet, p, store_.corners(touched.own, buffer));
  store_.set_max_radius2(touched.own, max_radius2);
  return max_radius2;
}

/// Moves the corners of f to where those of polygon_ are, if the edges are the same. Else false.
bool RestrictedPower::move_corners(FragmentId f) {
  const std::span<PolygonCorner> old = store_.corners_to_move(f);
  const std::span<const PolygonCorner> now = polygon_.corners;
  const std::size_t n = old.size();
  const auto first =
      static_cast<std::size_t>(std::ranges::find(old, now.front().edge, &PolygonCorner::edge) - old.begin());
  if (now.size() != n || first == n) return false;
  for (std::size_t k = 0, i = first; k < n; ++k, i = next_corner(i, n))
    if (old[i].edge != now[k].edge) return false;
  for (std::size_t k = 0, i = first; k < n; ++k, i = next_corner(i, n)) {
    old[i].point = now[k].point;
    move_circle(old[i]);
  }
  return true;
}

void RestrictedPower::move_circle(const PolygonCorner& corner) {
  if (!corner.circle.valid()) return;
  EmptyCircle circle = circles_[corner.circle];
  center_circle(circle, corner.point.position);
  circles_.move(corner.circle, circle.center, circle.radius2);
  change_.circles_moved.push_back(corner.circle);
}

}  // namespace geom
