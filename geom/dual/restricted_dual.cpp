#include "geom/dual/restricted_dual.h"

#include <algorithm>
#include <limits>

#include "geom/check.h"

namespace geom {

RestrictedDual::RestrictedDual(const TriMesh& mesh, CornerTypes types, NeighbourOracle* paper)
    : state_(mesh, types, paper), fast_(state_), redivision_(state_) {}

void RestrictedDual::begin() {
  state_.circles.recycle(change_.circles_erased);
  state_.circles.recycle(unlisted_);
  unlisted_.clear();
  change_.circles_erased.clear();
  change_.circles_created.clear();
  change_.circles_moved.clear();
  change_.cells.clear();
}

const RestrictedDual::Change& RestrictedDual::build(std::span<const WeightedPoint3> points,
                                                    std::span<const FacetId> homes,
                                                    std::span<const SiteId> order, int threads,
                                                    std::span<const KnownCell> known) {
  ensure(state_.num_sites == 0 && !points.empty(), "restricted dual: built once, of some sites");
  begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    state_.admit(SiteId(i), points[i]);
    state_.home[SiteId(i)] = homes[i];
  }
  for (const SiteId p : order) {
    state_.enter(p);
    if (state_.paper) state_.paper->insert(p, points[p.index()], SiteId());
  }
  state_.choose_search();
  redivision_.build(threads, change_);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (known.empty())
      fast_.certify(SiteId(i));
    else
      fast_.certify(SiteId(i), known[i]);
  return change_;
}

// --- updates -------------------------------------------------------------------------------------

const RestrictedDual::Change& RestrictedDual::insert(SiteId p, const WeightedPoint3& point, FacetId home,
                                                     CircleId at) {
  begin();
  insert_anyhow(p, point, home, at);
  return change_;
}

void RestrictedDual::insert_anyhow(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at) {
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
CircleId RestrictedDual::beaten_circle(const WeightedPoint3& point) const {
  const SiteId nearest = state_.tree.nearest({point.position, point.level}, SiteId()).site;
  CircleId best;
  double least = std::numeric_limits<double>::infinity();
  if (!nearest.valid()) return best;
  for (const CircleId c : circles_of(nearest)) {
    const double lead =
        power(Location3(circle(c).center, level_at(circle(c).facet, circle(c).center)), point) -
        circle(c).radius2;
    if (!(lead < least)) continue;
    least = lead;
    best = c;
  }
  return best;
}

const RestrictedDual::Change& RestrictedDual::remove(SiteId p) {
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

void RestrictedDual::remove_generally(SiteId p) {
  ++ways_.general_removals;
  redivision_.removal().commit(change_);
  state_.set_shape(p, CellShape::regular);
  forget_shapes();
}

/// After a general update: the sites around may be regular or not.
void RestrictedDual::forget_shapes() {
  std::vector<SiteId> around = change_.cells;
  for (const std::vector<CircleId>* list : {&change_.circles_erased, &change_.circles_created})
    for (const CircleId c : *list)
      for (const SiteId s : circle(c).sites)
        if (s.valid()) around.push_back(s);
  for (const SiteId s : around)
    if (state_.tree.contains(s)) state_.set_shape(s, CellShape::unknown);
}

std::optional<RestrictedDual::Plan> RestrictedDual::plan_removal(SiteId p) {
  begin();
  is_general_ = false;
  if (fast_.plan(p)) return Plan{fast_.rim(), fast_.circles(), fast_.reach(), fast_.max_radius2()};
  if (state_.corners.types() == CornerTypes::all || !has_cell(p)) return {};
  redivision_.removal().plan(p);
  if (!redivision_.removal().has_neighbours()) return {};
  is_general_ = true;
  return general_plan();
}

RestrictedDual::Plan RestrictedDual::plan_exactly(SiteId p) {
  if (!is_general_ && fast_.make_plan_exact())
    return {fast_.rim(), fast_.circles(), fast_.reach(), fast_.max_radius2()};
  if (!is_general_) {
    fast_.cancel();
    redivision_.removal().plan(p);
    is_general_ = true;
  }
  return general_plan();
}

RestrictedDual::Plan RestrictedDual::general_plan() const {
  const GeneralRemoval& removal = redivision_.removal();
  return {removal.heirs(), removal.circles(), removal.reach(), removal.power()};
}

const RestrictedDual::Change& RestrictedDual::stay(SiteId) {
  if (!is_general_) fast_.cancel();
  return change_;
}

const RestrictedDual::Change& RestrictedDual::move(SiteId p, const WeightedPoint3& point, FacetId home,
                                                   Target target) {
  if (is_general_) {
    remove_generally(p);
  } else {
    if (!target.circle.valid() && fast_.move_in_place(target.planned, point, change_)) {
      ++ways_.in_place;
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
void RestrictedDual::take_net_change() {
  std::vector<CircleId> passing;
  for (const CircleId c : change_.circles_created)
    if (std::ranges::find(change_.circles_erased, c) != change_.circles_erased.end()) passing.push_back(c);
  const auto is_passing = [&](CircleId c) { return std::ranges::find(passing, c) != passing.end(); };
  std::erase_if(change_.circles_created, is_passing);
  std::erase_if(change_.circles_erased, is_passing);
  unlisted_.insert(unlisted_.end(), passing.begin(), passing.end());
}

void RestrictedDual::expect(SiteId p, int calls) const {
  if (calls >= 4) return state_.circles.prefetch_list(p), prefetch(&state_.sites[p]);
  if (calls == 3) return state_.circles.prefetch_members(p);
  for (const CircleId c : circles_of(p)) {
    if (calls == 2) state_.circles.prefetch(c);
    if (calls != 1) continue;
    for (const SiteId s : circle(c).sites)
      if (s.valid()) prefetch(&state_.sites[s]), state_.circles.prefetch_list(s);
    for (const CircleId beyond : circle(c).beyond)
      if (beyond.valid()) state_.circles.prefetch(beyond);
  }
}

// --- questions -----------------------------------------------------------------------------------

void RestrictedDual::link(SiteId p, std::vector<SiteId>& out) const {
  out.clear();
  for (const CircleId c : circles_of(p))
    for (const SiteId s : circle(c).sites)
      if (s.valid() && s != p) out.push_back(s);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

double RestrictedDual::reach(SiteId p) {
  if (!has_cell(p)) return state_.reach[p];
  const double reach = redivision_.reach(p);
  state_.set_reach(p, reach);
  return reach;
}

std::vector<FacetPolygon> RestrictedDual::cell(SiteId p) {
  std::vector<FacetPolygon> polygons;
  const CellPieces& cell = redivision_.cell(p);
  for (const CellPieces::Piece& piece : cell.pieces) {
    const std::span<const PolygonCorner> corners = cell.corners_of(piece);
    polygons.push_back({piece.facet, p, {corners.begin(), corners.end()}});
  }
  std::ranges::sort(polygons, {}, &FacetPolygon::facet);
  return polygons;
}

void RestrictedDual::check() const {
  state_.circles.check();
  state_.tree.check();
}

}  // namespace geom
