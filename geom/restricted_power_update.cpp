// Insertion and removal of a site in the restricted power diagram (paper, section 4.2, figure 6 (b) and (c)).

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/restricted_power.h"

namespace geom {

void RestrictedPower::begin(SiteId p) {
  circles_.recycle(change_.circles_erased);
  change_.circles_erased.clear();
  change_.circles_created.clear();
  change_.circles_moved.clear();
  change_.cells.clear();
  change_.erased.clear();
  change_.created.clear();
  change_.cut.clear();
  ++stamp_;
  if (p.index() >= cell_stamp_.size()) {
    cell_stamp_.resize(p.index() + 1, 0);
    reach_.resize(p.index() + 1, -std::numeric_limits<double>::infinity());
  }
}

void RestrictedPower::admit(SiteId p, const WeightedPoint3& point) {
  ensure(point.position.lpNorm<Eigen::Infinity>() <= extent_,
         "restricted power diagram: a site outside the mesh's box");
  if (p.index() >= sites_.size()) sites_.resize(p.index() + 1);
  sites_[p] = point;
}

/// Tells the source how far the changed cells reach now.
void RestrictedPower::finish() {
  for (const SiteId j : change_.cells) neighbours_.set_reach(j, reach_[j]);
}

void RestrictedPower::touch_cell(SiteId j) {
  if (cell_stamp_[j] == stamp_) return;
  cell_stamp_[j] = stamp_;
  change_.cells.push_back(j);
}

// --- insertion -----------------------------------------------------------------------------------

// The power of p less that of the owner is affine on a fragment, so p takes a part of it iff it beats the
// owner at a corner. First the fragments of all rivals are cut; then p's own fragment on each facet touched
// is put together from the new edges.
const RestrictedPower::Change& RestrictedPower::after_insert(SiteId p, const WeightedPoint3& point) {
  begin(p);
  admit(p, point);
  reach_[p] = -std::numeric_limits<double>::infinity();
  if (store_.size() == 0) {
    occupy_everything(p);
  } else {
    candidates_.clear();
    neighbours_.rivals(p, candidates_);
    std::ranges::sort(candidates_);  // one order of changes, whatever the source
    meet_rivals(p);
    for (const Prospect& prospect : prospects_) take_from(prospect, p);
    note_losses();
    for (const CellAssembly::TouchedFacet& touched : assembly_.facets()) {
      assembly_.assemble(touched, p, polygon_);
      reach_[p] = std::max(reach_[p], commit(FragmentId(), polygon_));
    }
    assembly_.clear();
  }
  finish();
  neighbours_.set_reach(p, reach_[p]);
  return change_;
}

/// Lists the candidates as rivals of p, and their fragments of which p may win something, marked ones left out
/// (after_move() has another way for those). The memory is asked for all
/// that will be read, in as many steps as there are pointers to follow.
void RestrictedPower::meet_rivals(SiteId p) {
  rivals_.clear();
  prospects_.clear();
  for (const SiteId j : candidates_) store_.prefetch_cell(j);
  for (const SiteId j : candidates_) store_.prefetch_members(j);
  for (const SiteId j : candidates_)
    for (const FragmentId f : store_.of_cell(j)) store_.prefetch_fragment(f);
  for (const SiteId j : candidates_)
    for (const FragmentId f : store_.of_cell(j)) clipper_.prefetch_facet(store_.facet(f));
  for (const SiteId j : candidates_) {
    rivals_.push_back({j, clipper_.bisector_of(j, p), false});
    for (const FragmentId f : store_.of_cell(j)) {
      if (store_.marked(f)) continue;
      const Clip whole = clipper_.compare_on_facet(store_.facet(f), rivals_.back().bisector);
      if (whole == Clip::untouched) continue;
      store_.prefetch_corners(f);
      prospects_.push_back({f, rivals_.size() - 1, whole});
    }
  }
}

void RestrictedPower::expect(SiteId p, int moves) const {
  const std::span<const FragmentId> cell = store_.of_cell(p);
  if (moves >= 4) store_.prefetch_cell(p);
  if (moves == 3) store_.prefetch_members(p);
  if (moves == 2)
    for (const FragmentId f : cell) store_.prefetch_fragment(f);
  if (moves <= 1)
    for (const FragmentId f : cell) {
      store_.prefetch_facet(store_.facet(f));
      store_.prefetch_corners(f);
    }
}

void RestrictedPower::occupy_everything(SiteId p) {
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
    clipper_.start(polygon_, t, p);
    reach_[p] = std::max(reach_[p], commit(FragmentId(), polygon_));
  }
}

/// Cuts a rival's fragment by p and notes its facet if p wins something there.
void RestrictedPower::take_from(const Prospect& prospect, SiteId p) {
  const FragmentId f = prospect.fragment;
  const FacetId t = store_.facet(f);
  Rival& rival = rivals_[prospect.rival];
  Clip outcome = prospect.whole;
  if (outcome == Clip::cut) {
    std::array<PolygonCorner, 3> buffer;
    const std::span<const PolygonCorner> corners = store_.corners(f, buffer);
    outcome = clipper_.classify_corners(t, rival.site, corners, p, rival.bisector, beaten_);
    if (outcome == Clip::untouched) return;
    if (outcome == Clip::cut) {
      cut_polygon(t, rival.site, corners, p, rival.bisector);
      commit(f, polygon_);
    }
  }
  rival.changed = true;
  if (outcome == Clip::swallowed) {
    assembly_.win_on(t);
    forget(f);
  }
}

/// The cells of the rivals are what they will be: how far do those reach that have changed?
void RestrictedPower::note_losses() {
  for (const Rival& rival : rivals_) {
    if (!rival.changed) continue;
    touch_cell(rival.site);
    double reach = -std::numeric_limits<double>::infinity();
    for (const FragmentId f : store_.of_cell(rival.site)) reach = std::max(reach, store_.max_radius2(f));
    reach_[rival.site] = reach;
  }
}

/// Puts into polygon_ what p leaves of j's polygon on facet t: takes away the corners noted in beaten_. Notes the
/// cut and erases the circles of those corners.
void RestrictedPower::cut_polygon(FacetId t, SiteId j, std::span<const PolygonCorner> corners, SiteId p,
                                  const Bisector& b) {
  const CutPlace place = Clipper::place_of_cut(corners, beaten_);
  const std::array<RoundedPoint, 2> ends = assembly_.add_cut(t, {j, place.leaving, place.entering}, p, b);
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (beaten_[k]) erase_circle_of(corners[k]);
  polygon_.facet = t;
  polygon_.owner = j;
  Clipper::cut(corners, place, p, ends, polygon_.corners);
}

// --- removal -------------------------------------------------------------------------------------

// The sites on the other side of the cell's boundary are known from the labels; nearly always they are all
// the heirs. The vacancy is divided among them, and then the source is asked for others that could beat the
// result. If there are any, they join the heirs and the vacancy is divided again.
const RestrictedPower::Change& RestrictedPower::after_remove(SiteId p) {
  begin(p);
  if (vacate(p)) {
    if (division_.heirs().empty()) {  // p owned whole components of the surface alone
      const SiteId nearest = neighbours_.nearest(sites_[p].position, p, SiteId()).site;
      if (nearest.valid()) division_.add_heir(nearest);
    }
    if (!division_.heirs().empty()) divide_vacancy(p);
    carry_out_division(p);
    if (division_.heirs().empty()) {
      for (CircleId& c : vertex_circle_) {
        if (c.valid()) erase_circle(c);
        c = CircleId();
      }
    }
  }
  finish();
  return change_;
}

/// Begins to divide p's cell; false if that is empty.
bool RestrictedPower::vacate(SiteId p) {
  const std::span<const FragmentId> cell = store_.of_cell(p);
  for (const FragmentId f : cell) store_.prefetch_members(store_.facet(f));
  for (const FragmentId f : cell)
    for (const PolygonCorner& corner : store_.corners(f))
      if (corner.circle.valid()) circles_.prefetch(corner.circle);
  vacated_.assign(cell.begin(), cell.end());
  if (vacated_.empty()) return false;
  division_.begin(p, vacated_);
  return true;
}

void RestrictedPower::divide_vacancy(SiteId p) {
  deferred_.clear();
  do division_.divide();
  while (add_missing_heirs(p, neighbours_));
}

const RestrictedPower::Change& RestrictedPower::abandon(SiteId p, std::span<const FragmentId> fragments,
                                                        std::span<const SiteId> excluded,
                                                        const NeighbourSource& search) {
  begin(p);
  vacated_.assign(fragments.begin(), fragments.end());
  division_.begin(p, vacated_, excluded);
  if (division_.heirs().empty()) return change_;
  do division_.divide_by_clipping();
  while (add_missing_heirs(p, search));
  const bool fits = !division_.misfit() && std::ranges::all_of(division_.shares(), [&](const auto& share) {
    return !share.joins.valid() || seam_of(share.joins, share.polygon, p).fits;
  });
  if (fits) carry_out_division(p);
  return change_;
}

/// Asks the source for sites that beat the division somewhere; true if there are any, which are heirs now.
bool RestrictedPower::add_missing_heirs(SiteId p, const NeighbourSource& source) {
  // At the corners of p's cell the power has not changed.
  const double radius2 = std::max(reach(p) + sites_[p].weight, 0.0);
  candidates_.clear();
  source.heirs({p, sites_[p].position, std::sqrt(radius2), std::max(reach(p), division_.max_radius2())},
               candidates_);
  std::ranges::sort(candidates_);
  const std::size_t known = division_.heirs().size();
  std::erase_if(candidates_, [&](SiteId j) { return !division_.is_stranger(j); });
  for (const SiteId j : candidates_)
    if (division_.is_missing(j)) division_.add_heir(j);
  return division_.heirs().size() > known;
}

void RestrictedPower::carry_out_division(SiteId p) {
  for (const FragmentId f : vacated_) forget(f);
  if (division_.heirs().empty()) return;
  for (auto& [joins, share] : division_.shares()) {
    touch_cell(share.owner);
    if (joins.valid()) join(joins, share, p);
    reach_[share.owner] = std::max(reach_[share.owner], commit(joins, joins.valid() ? polygon_ : share));
  }
}

//     old fragment of k        Both are convex and share the edge between k and p, so their union (convex
//    b ___________ a           again, a fragment of the new diagram) is the old polygon with that edge replaced
//     \_____p_____/            by the rest of the share: its edges from a to b. The lines of a and b go on
//      \  share  /             across the corners where they met p, so these corners vanish.
//       \__x1___/
RestrictedPower::Seam RestrictedPower::seam_of(FragmentId old, const FacetPolygon& share, SiteId p) const {
  const EdgeLabel border = EdgeLabel::bisector(p);
  const std::span<const PolygonCorner> corners = store_.corners(old);
  const auto position = [&](std::span<const PolygonCorner> of) {
    return static_cast<std::size_t>(std::ranges::find(of, border, &PolygonCorner::edge) - of.begin());
  };
  const std::size_t n = corners.size(), q = position(corners), m = share.corners.size(),
                    g = position(share.corners);
  return {q, g,
          q < n && g < m && corners[(q + n - 1) % n].edge == share.corners[(g + 1) % m].edge &&
              corners[(q + 1) % n].edge == share.corners[(g + m - 1) % m].edge};
}

/// Puts the union of an old fragment and a share of p's into polygon_.
void RestrictedPower::join(FragmentId old, const FacetPolygon& share, SiteId p) {
  const Seam seam = seam_of(old, share, p);
  unite(old, share, seam, polygon_);
  const std::span<const PolygonCorner> corners = store_.corners(old);
  erase_circle_of(corners[seam.in_old]);
  erase_circle_of(corners[next_corner(seam.in_old, corners.size())]);
}

void RestrictedPower::unite(FragmentId old, const FacetPolygon& share, const Seam& seam,
                            FacetPolygon& out) const {
  const auto [q, g, fits] = seam;
  ensure(fits, "restricted power diagram: a share does not fit its neighbour");
  const std::span<const PolygonCorner> corners = store_.corners(old);
  const std::size_t n = corners.size(), m = share.corners.size();
  out.facet = share.facet;
  out.owner = share.owner;
  out.corners.clear();
  for (std::size_t i = next_corner(next_corner(q, n), n); i != q; i = next_corner(i, n))
    out.corners.push_back(corners[i]);
  for (std::size_t i = next_corner(next_corner(g, m), m); i != g; i = next_corner(i, m))
    out.corners.push_back(share.corners[i]);
}

}  // namespace geom
