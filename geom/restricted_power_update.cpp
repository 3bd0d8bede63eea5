// Insertion and removal of a site in the restricted power diagram (paper, section 4.2, figure 6 (b) and (c)).

#include <algorithm>
#include <numeric>

#include "geom/check.h"
#include "geom/restricted_power.h"

namespace geom {

void RestrictedPower::begin(SiteId p) {
  free_circles_.insert(free_circles_.end(), change_.circles_erased.begin(), change_.circles_erased.end());
  change_.circles_erased.clear();
  change_.circles_created.clear();
  change_.cells.clear();
  change_.erased.clear();
  change_.created.clear();
  change_.cut.clear();
  ++stamp_;
  if (p.index() >= cell_stamp_.size()) {
    cell_stamp_.resize(p.index() + 1, 0);
    heir_stamp_.resize(p.index() + 1, 0);
    heir_index_.resize(p.index() + 1, 0);
    reach_.resize(p.index() + 1, -std::numeric_limits<double>::infinity());
  }
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
// is the facet clipped by the rivals that kept a part of it there.
const RestrictedPower::Change& RestrictedPower::after_insert(SiteId p, const WeightedPoint3& point) {
  ensure(point.position.lpNorm<Eigen::Infinity>() <= extent_,
         "restricted power diagram: a site outside the mesh's box");
  if (p.index() >= sites_.size()) sites_.resize(p.index() + 1);
  sites_[p] = point;
  begin(p);
  reach_[p] = -std::numeric_limits<double>::infinity();
  if (store_.size() == 0) {
    occupy_everything(p);
  } else {
    candidates_.clear();
    neighbours_.rivals(p, candidates_);
    std::ranges::sort(candidates_);  // one order of changes, whatever the source
    for (const SiteId j : candidates_)
      if (take_from(j, p)) touch_cell(j);
    for (const TouchedFacet& touched : touched_facets_) {
      clipper_.start(polygon_, touched.facet, p);
      for (std::int32_t link = touched.rivals; link >= 0;
           link = rival_links_[static_cast<std::size_t>(link)].next)
        clipper_.clip(polygon_, rival_links_[static_cast<std::size_t>(link)].site);
      ensure(!polygon_.corners.empty(),
             "restricted power diagram: a site takes from a facet but gets nothing");
      reach_[p] = std::max(reach_[p], commit(FragmentId(), polygon_));
      facet_mark_[touched.facet] = -1;
    }
    touched_facets_.clear();
    rival_links_.clear();
  }
  finish();
  neighbours_.set_reach(p, reach_[p]);
  return change_;
}

/// Cuts the fragments of j by p and notes the facets where p wins something. True if it does. Computes the
/// reach of what is left of j.
bool RestrictedPower::take_from(SiteId j, SiteId p) {
  const Bisector b = clipper_.bisector_of(j, p);
  std::array<PolygonCorner, 3> buffer;
  double reach = -std::numeric_limits<double>::infinity();
  bool took = false;
  for (FragmentId f = store_.first_of_cell(j), next; f.valid(); f = next) {
    next = store_.next_in_cell(f);
    const FacetId t = store_.facet(f);
    Clip outcome = clipper_.compare_on_facet(t, b);
    if (outcome == Clip::cut) {
      const std::span<const PolygonCorner> corners = store_.corners(f, buffer);
      outcome = clipper_.classify_corners(t, j, corners, p, b, beaten_);
      if (outcome == Clip::cut) {
        polygon_.facet = t;
        polygon_.owner = j;
        polygon_.corners.assign(corners.begin(), corners.end());
        clipper_.cut(polygon_, p, b, beaten_);
        TouchedFacet& touched = touch_facet(t);
        rival_links_.push_back({j, touched.rivals});
        touched.rivals = static_cast<std::int32_t>(rival_links_.size()) - 1;
        commit(f, polygon_);
      }
    }
    if (outcome == Clip::swallowed) {
      touch_facet(t);
      forget(f);
    } else {
      reach = std::max(reach, store_.max_radius2(f));
    }
    took = took || outcome != Clip::untouched;
  }
  if (took) reach_[j] = reach;
  return took;
}

RestrictedPower::TouchedFacet& RestrictedPower::touch_facet(FacetId t) {
  std::int32_t& mark = facet_mark_[t];
  if (mark < 0) {
    mark = static_cast<std::int32_t>(touched_facets_.size());
    touched_facets_.push_back({t, -1});
  }
  return touched_facets_[static_cast<std::size_t>(mark)];
}

void RestrictedPower::occupy_everything(SiteId p) {
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
    clipper_.start(polygon_, t, p);
    reach_[p] = std::max(reach_[p], commit(FragmentId(), polygon_));
  }
}

// --- removal -------------------------------------------------------------------------------------

// The sites on the other side of the cell's boundary are known from the labels; nearly always they are all
// the heirs. The vacancy is divided among them, and then the source is asked for others that could beat the
// result: a site that owns a part of the vacancy beats the division at one of its corners, because the
// difference of powers is affine on each piece. If there are any, they join the heirs and the vacancy is
// divided again.
const RestrictedPower::Change& RestrictedPower::after_remove(SiteId p) {
  begin(p);
  vacated_.clear();
  for (FragmentId f = store_.first_of_cell(p); f.valid(); f = store_.next_in_cell(f)) vacated_.push_back(f);
  if (vacated_.empty()) return change_;
  gather_known_heirs(vacated_);
  if (heirs_.empty()) {  // p owned whole components of the surface alone
    const SiteId nearest = neighbours_.nearest(sites_[p].position, p, SiteId()).site;
    if (nearest.valid()) add_heir(nearest);
  }
  plan_division(p, neighbours_);
  ensure(!misfit_, "restricted power diagram: a share does not fit its neighbour");
  carry_out_division(p);
  if (heirs_.empty()) {  // nobody is left
    for (CircleId& c : vertex_circle_) {
      if (c.valid()) erase_circle(c);
      c = CircleId();
    }
  }
  finish();
  return change_;
}

const RestrictedPower::Change& RestrictedPower::abandon(SiteId p, std::span<const FragmentId> fragments,
                                                        std::span<const SiteId> excluded,
                                                        const NeighbourSource& search) {
  begin(p);
  vacated_.assign(fragments.begin(), fragments.end());
  heir_stamp_[p] = stamp_;  // those who are known already are never added
  for (const SiteId s : excluded) heir_stamp_[s] = stamp_;
  gather_known_heirs(vacated_);
  if (heirs_.empty()) return change_;
  plan_division(p, search);
  if (!misfit_) carry_out_division(p);
  return change_;
}

/// Divides what p has to leave among the heirs and those that the source knows besides. A misfit is a share
/// that does not lie along the fragment that it should join.
void RestrictedPower::plan_division(SiteId p, const NeighbourSource& source) {
  num_pending_ = 0;
  misfit_ = false;
  if (heirs_.empty()) return;
  do {
    num_pending_ = 0;
    prepare_bisectors();
    for (const FragmentId f : vacated_) divide(f, p);
  } while (add_missing_heirs(p, source));
  for (std::size_t i = 0; i < num_pending_; ++i)
    if (pending_[i].joins.valid()) misfit_ |= !seam_of(pending_[i].joins, pending_[i].share, p).fits;
}

void RestrictedPower::carry_out_division(SiteId p) {
  for (const FragmentId f : vacated_) forget(f);
  for (std::size_t i = 0; i < num_pending_; ++i) {
    const auto& [joins, share] = pending_[i];
    touch_cell(share.owner);
    if (joins.valid())
      join(joins, share, p);
    else
      polygon_ = share;
    reach_[share.owner] = std::max(reach_[share.owner], commit(joins, polygon_));
  }
}

/// The sites that the boundary of the vacated fragments is labelled with.
void RestrictedPower::gather_known_heirs(std::span<const FragmentId> vacated) {
  heirs_.clear();
  for (const FragmentId f : vacated)
    for (const PolygonCorner& corner : store_.corners(f))
      if (corner.edge.is_site() && heir_stamp_[corner.edge.site()] != stamp_) add_heir(corner.edge.site());
}

void RestrictedPower::add_heir(SiteId k) {
  heir_stamp_[k] = stamp_;
  heir_index_[k] = static_cast<std::int32_t>(heirs_.size());
  heirs_.push_back(k);
}

RestrictedPower::Pending& RestrictedPower::add_pending() {
  if (num_pending_ == pending_.size()) pending_.emplace_back();
  Pending& pending = pending_[num_pending_++];
  pending.joins = FragmentId();
  return pending;
}

// Divides one fragment P of p, on facet t, among the heirs H, which contain every label of P. The share of k
// is
//
//     { x in t : p beats k at x, and k beats every other h in H at x }
//
// because where k beats all labels of P and p beats k, p beats them too, and the location is in P. If P has
// an edge labelled k, the share lies along that edge and joins the fragment that k has there. If not, it is
// an island, for on every edge of P another heir is nearer than k; then p beats k on all of { k beats every
// other h } or nowhere on it, and a k that has a fragment on t already has no share, because the two would
// make one convex fragment.
void RestrictedPower::divide(FragmentId vacated, SiteId p) {
  const FacetId t = store_.facet(vacated);
  order_heirs(vacated);
  const bool whole = store_.whole(vacated);
  if (whole && inherits_whole(t)) return;
  std::array<PolygonCorner, 3> buffer;
  const std::span<const PolygonCorner> vacancy = store_.corners(vacated, buffer);
  find_fragments_of_heirs(vacated);
  for (const std::size_t i : heirs_order_) {
    const SiteId k = heirs_[i];
    const FragmentId old = heirs_fragments_[i];
    const bool borders = std::ranges::any_of(
        vacancy, [&](const PolygonCorner& c) { return c.edge == EdgeLabel::bisector(k); });
    if (!borders && (old.valid() || yields_everywhere(i, vacancy))) continue;
    Pending& pending = add_pending();
    pending.joins = old;
    FacetPolygon& share = pending.share;
    clipper_.start(share, t, k);
    const Bisector beyond = clipper_.bisector_of(k, p);
    if (borders) clipper_.clip_beyond(share, p, beyond);
    for (const std::size_t h : heirs_order_) {
      if (share.corners.empty()) break;
      if (h != i) clipper_.clip(share, heirs_[h], bisector_of_heirs(i, h));
    }
    misfit_ |= borders && share.corners.empty();
    if (share.corners.empty() || (!borders && !clipper_.beats_at(share, 0, p, beyond))) --num_pending_;
  }
}

/// Is some other heir surely nearer than heir i at every corner of this polygon, hence all over it? Most
/// heirs that do not border a fragment are dismissed by this. "No" means nothing: the corners are rounded.
bool RestrictedPower::yields_everywhere(std::size_t i, std::span<const PolygonCorner> corners) const {
  return std::ranges::any_of(heirs_order_, [&](std::size_t h) {
    const Bisector& b = bisector_of_heirs(i, h);
    return h != i && std::ranges::all_of(corners, [&](const PolygonCorner& c) {
             return b(c.point.position) < -(b.error + b.length * c.point.tolerance);
           });
  });
}

/// What the heirs have on the facet of a vacated fragment: from the facet's list if that is short, else one
/// by one.
void RestrictedPower::find_fragments_of_heirs(FragmentId vacated) {
  heirs_fragments_.assign(heirs_.size(), FragmentId());
  if (store_.whole(vacated)) return;
  const FacetId t = store_.facet(vacated);
  std::size_t steps = 0;
  const std::size_t short_list = 8 * heirs_.size();
  for (FragmentId f = store_.first_of_facet(t); f.valid() && steps <= short_list;
       f = store_.next_in_facet(f), ++steps) {
    const auto i = static_cast<std::size_t>(heir_index_[store_.site(f)]);
    if (i < heirs_.size() && heirs_[i] == store_.site(f)) heirs_fragments_[i] = f;
  }
  if (steps <= short_list) return;
  for (std::size_t i = 0; i < heirs_.size(); ++i) heirs_fragments_[i] = store_.find(heirs_[i], t);
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
  const auto [q, g, fits] = seam_of(old, share, p);
  const std::span<const PolygonCorner> corners = store_.corners(old);
  const std::size_t n = corners.size(), m = share.corners.size();
  polygon_.facet = share.facet;
  polygon_.owner = share.owner;
  polygon_.corners.clear();
  for (std::size_t i = 2; i < n; ++i) polygon_.corners.push_back(corners[(q + i) % n]);
  for (std::size_t i = 2; i < m; ++i) polygon_.corners.push_back(share.corners[(g + i) % m]);
}

void RestrictedPower::prepare_bisectors() {
  heirs_bisectors_.clear();
  for (const SiteId k : heirs_)
    for (const SiteId h : heirs_) heirs_bisectors_.push_back(clipper_.bisector_of(k, h));
}

/// First the heirs that border the vacancy on its facet; if none does, the one that is nearest to the facet's
/// middle.
void RestrictedPower::order_heirs(FragmentId vacated) {
  heirs_order_.resize(heirs_.size());
  std::iota(heirs_order_.begin(), heirs_order_.end(), std::size_t{0});
  std::size_t front = 0;
  for (const PolygonCorner& corner : store_.corners(vacated)) {
    if (!corner.edge.is_site()) continue;
    for (std::size_t i = front; i < heirs_order_.size(); ++i)
      if (heirs_[heirs_order_[i]] == corner.edge.site()) std::swap(heirs_order_[i], heirs_order_[front++]);
  }
  if (front > 0) return;
  const Vec3 middle = clipper_.middle(store_.facet(vacated));
  std::size_t best = 0;
  for (std::size_t i = 1; i < heirs_.size(); ++i)
    if (bisector_of_heirs(best, i)(middle) < 0) best = i;
  std::swap(heirs_order_[0], heirs_order_[best]);
}

/// For a facet that p owned whole: does the first heir in order get all of it? Then that is noted.
bool RestrictedPower::inherits_whole(FacetId t) {
  const std::size_t first = heirs_order_.front();
  clipper_.start(polygon_, t, heirs_[first]);
  for (std::size_t h = 0; h < heirs_.size(); ++h) {
    if (h == first) continue;
    const Bisector& b = bisector_of_heirs(first, h);
    if (clipper_.classify(t, polygon_.owner, polygon_.corners, heirs_[h], b, beaten_) != Clip::untouched)
      return false;
  }
  clipper_.start(add_pending().share, t, heirs_[first]);
  return true;
}

/// Asks the source for sites that beat the division somewhere; true if there are any, which are heirs now.
bool RestrictedPower::add_missing_heirs(SiteId p, const NeighbourSource& source) {
  double max_radius2 = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < num_pending_; ++i)
    max_radius2 = std::max(max_radius2, bound_radius2(pending_[i].share));
  const double radius2 = std::max(reach(p) + sites_[p].weight, 0.0);
  candidates_.clear();
  source.heirs({p, sites_[p].position, std::sqrt(radius2), max_radius2}, candidates_);
  std::ranges::sort(candidates_);
  const auto beats_the_division = [&](SiteId j) {
    const EdgeLabel own = EdgeLabel::bisector(j);
    for (std::size_t i = 0; i < num_pending_; ++i) {
      const FacetPolygon& share = pending_[i].share;
      const Bisector b = clipper_.bisector_of(share.owner, j);
      if (clipper_.compare_on_facet(share.facet, b) == Clip::untouched) continue;
      for (std::size_t k = 0; k < share.corners.size(); ++k)  // where an edge is labelled j, j is no news
        if (share.corners[k].edge != own && share.edge_before(k) != own && clipper_.beats_at(share, k, j, b))
          return true;
    }
    return false;
  };
  const std::size_t known = heirs_.size();
  for (const SiteId j : candidates_) {
    if (heir_stamp_[j] == stamp_ || !beats_the_division(j)) continue;
    add_heir(j);
  }
  return heirs_.size() > known;
}

}  // namespace geom
