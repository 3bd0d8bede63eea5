#include "geom/dual/general_insertion.h"

#include <algorithm>

namespace geom {

void GeneralInsertion::insert(SiteId p, const WeightedPoint3& point, DualChange& change) {
  enter(p, point);
  const double power = find_rivals(p);
  erase_beaten(p, change);
  const double reach = clipper_.clip(p, power, around_, cell_);
  find_circles(p);
  edges_.begin(p, {}, found_);
  edges_.add(cell_);
  const std::span<const CircleId> created = create_all(found_, state_.circles, change);
  edges_.connect(created);
  cut_.connect(p, found_, created);
  state_.reach.set(p, reach);
  find_hidden();
}

void GeneralInsertion::enter(SiteId p, const WeightedPoint3& point) {
  const SiteId hint = state_.paper && state_.search.size() > 0
                          ? state_.search.tree().nearest(point.position, SiteId()).site
                          : SiteId();
  state_.admit(p, point);
  if (state_.paper) state_.paper->insert(p, point, hint);
  state_.enter(p);
}

/// Whoever loses something to p is among the rivals. So no location of the new cell has more power than the
/// farthest of their cells: than what is returned.
double GeneralInsertion::find_rivals(SiteId p) {
  rivals_.clear();
  if (state_.search.size() == 1) return infinity;
  state_.search.tree().rivals(p, rivals_);
  double power = -infinity;
  for (const SiteId j : rivals_) power = std::max(power, state_.reach[j]);
  return power;
}

/// The circles that p beats go; whom they touch is around p.
void GeneralInsertion::erase_beaten(SiteId p, DualChange& change) {
  beaten_.clear();
  for (const SiteId j : rivals_)
    for (const CircleId c : state_.circles.of_site(j))
      if (state_.circles[c].sites[0] == j && is_beaten(state_.circles[c], p)) beaten_.push_back(c);
  cut_.cut(beaten_);
  around_.clear();
  for (const CircleId c : beaten_) {
    for (const SiteId s : state_.circles[c].sites)
      if (s.valid() && std::ranges::find(around_, s) == around_.end()) around_.push_back(s);
    state_.circles.erase(c);
    change.circles_erased.push_back(c);
  }
}

/// Mostly doubles tell.
bool GeneralInsertion::is_beaten(const EmptyCircle& circle, SiteId p) const {
  if (state_.lead_at(circle, state_.sites[p]).positive()) return false;
  return state_.clipper.beats_at(state_.corners.corner_of(circle, 2 * state_.clipper.most_tolerance()), p,
                                 state_.clipper.bisector_of(circle.sites[0], p));
}

void GeneralInsertion::find_circles(SiteId p) {
  found_.clear();
  for (const CellPieces::Piece& piece : cell_.pieces)
    for (std::size_t k = 0; k < piece.size; ++k) {
      EmptyCircle circle;
      if (state_.corners.find_of_any({piece.facet, p, cell_.corners_of(piece)}, k, circle))
        found_.push_back(circle);
    }
  std::ranges::sort(found_, circle_before);
}

/// Surely nobody else is as near to the place of j.
bool GeneralInsertion::owns_its_place(SiteId j) const {
  const WeightedPoint3& site = state_.sites[j];
  const SiteId next = state_.nearest({site.position, site.level}, j).site;
  return next.valid() && state_.leads_at_its_place(j, state_.sites[next]);
}

/// Rivals that have no circle any more: p may have hidden them. Not those that have their places still, or a
/// part of a facet: one is looked at, for cells that go round a horn have hundreds, and no circle for long.
void GeneralInsertion::find_hidden() {
  part_of_.resize(state_.sites.size());
  for (const SiteId j : rivals_) {
    if (!state_.circles.of_site(j).empty() || !(state_.reach[j] > -infinity)) continue;
    if (owns_its_place(j)) continue;
    if (part_of_[j].valid() && clipper_.has_part_of(part_of_[j], j)) continue;
    state_.reach.set(j, clipper_.clip(j, spare_));
    part_of_[j] = spare_.pieces.empty() ? FacetId() : spare_.pieces[spare_.pieces.size() / 2].facet;
  }
}

}  // namespace geom
