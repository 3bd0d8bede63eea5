#include "geom/dual/dual_updates.h"

#include <algorithm>
#include <limits>

#include "geom/check.h"

namespace geom {
namespace {

constexpr std::size_t most_of_a_move = 1000;

}  // namespace

void DualUpdates::begin() {
  certify_all();
  state_.circles.recycle(change_.circles_erased);
  state_.circles.recycle(unlisted_);
  unlisted_.clear();
  change_.circles_erased.clear();
  change_.circles_moved.clear();
  change_.cells.clear();
  if (change_.circles_created.size() > most_of_a_move) std::vector<CircleId>().swap(change_.circles_created);
  change_.circles_created.clear();
}

const DualChange& DualUpdates::build(std::vector<WeightedPoint3> points, std::span<const FacetId> homes,
                                     std::span<const SiteId> order, int threads, const KnownDiagram& known) {
  ensure(state_.search.size() == 0 && !points.empty(), "restricted dual: built once, of some sites");
  begin();
  state_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    state_.admit(SiteId(i), points[i]);
    state_.home[SiteId(i)] = homes[i];
  }
  std::vector<WeightedPoint3>().swap(points);  // the state has them
  for (const SiteId p : order) {
    state_.search.enter(p);
    if (state_.paper) state_.paper->insert(p, state_.sites[p], SiteId());
  }
  state_.choose_search();
  redivision_.build(threads, known, change_);
  are_certified_ = false;
  if (!known.cells.empty()) certify_all(known.cells);
  return change_;
}

void DualUpdates::certify_all(std::span<const KnownCell> known) {
  if (are_certified_) return;
  fast_.reserve(state_.sites.size());
  for (SiteId p(0); p.index() < state_.sites.size(); p = SiteId(p.value + 1))
    if (known.empty())
      fast_.certify(p);
    else
      fast_.certify(p, known[p.index()]);
  are_certified_ = true;
}

const DualChange& DualUpdates::insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at) {
  begin();
  insert_anyhow(p, point, home, at);
  return change_;
}

void DualUpdates::insert_anyhow(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at) {
  if (!at.valid()) at = beaten_circle(point);
  if (at.valid() && home.valid() && fast_.insert(p, point, home, at, change_)) {
    ++ways_.fast_insertions;
    return;
  }
  ++ways_.general_insertions;
  redivision_.insert(p, point, change_);
  state_.home[p] = home;
  forget_shapes();
  state_.set_shape(p, CellShape::unknown);
}

/// One of the circles around the nearest site that the point beats, probably; none if there is none.
CircleId DualUpdates::beaten_circle(const WeightedPoint3& point) const {
  const SiteId nearest = state_.search.tree().nearest({point.position, point.level}, SiteId()).site;
  CircleId best;
  double least = std::numeric_limits<double>::infinity();
  if (!nearest.valid()) return best;
  for (const CircleId c : state_.circles.of_site(nearest)) {
    const EmptyCircle& circle = state_.circles[c];
    const Location3 center(circle.center, state_.clipper.levels().at(circle.facet, circle.center));
    const double lead = power(center, point) - circle.radius2;
    if (!(lead < least)) continue;
    least = lead;
    best = c;
  }
  return best;
}

const DualChange& DualUpdates::remove(SiteId p) {
  begin();
  if (fast_.plan(p)) {
    ++ways_.fast_removals;
    fast_.remove(change_);
  } else {
    redivision_.removal().plan(p);
    remove_generally(p);
  }
  return change_;
}

void DualUpdates::remove_generally(SiteId p) {
  ++ways_.general_removals;
  redivision_.removal().commit(change_);
  state_.set_shape(p, CellShape::regular);
  forget_shapes();
}

/// After a general update: the sites around may be regular or not.
void DualUpdates::forget_shapes() {
  std::vector<SiteId> around = change_.cells;
  for (const std::vector<CircleId>* list : {&change_.circles_erased, &change_.circles_created})
    for (const CircleId c : *list)
      for (const SiteId s : state_.circles[c].sites)
        if (s.valid()) around.push_back(s);
  for (const SiteId s : around)
    if (state_.search.tree().contains(s)) state_.set_shape(s, CellShape::unknown);
}

const DualChange& DualUpdates::move(SiteId p, const WeightedPoint3& point, FacetId home,
                                    PlannedRemoval::Target target, bool is_fast) {
  if (!is_fast) {
    remove_generally(p);
  } else {
    if (!target.circle.valid() && fast_.move_in_place(target.planned, point, change_)) {
      ++ways_.in_place;
      ways_.with_leeway += fast_.had_leeway();
      return change_;
    }
    ++ways_.fast_removals;
    fast_.remove(change_);
  }
  if (!target.circle.valid()) target.circle = change_.circles_created[target.planned];
  insert_anyhow(p, point, home, target.circle);
  take_net_change();
  return change_;
}

/// What was created and erased again is not told.
void DualUpdates::take_net_change() {
  std::vector<CircleId> passing;
  for (const CircleId c : change_.circles_created)
    if (std::ranges::find(change_.circles_erased, c) != change_.circles_erased.end()) passing.push_back(c);
  const auto is_passing = [&](CircleId c) { return std::ranges::find(passing, c) != passing.end(); };
  std::erase_if(change_.circles_created, is_passing);
  std::erase_if(change_.circles_erased, is_passing);
  unlisted_.insert(unlisted_.end(), passing.begin(), passing.end());
}

}  // namespace geom
