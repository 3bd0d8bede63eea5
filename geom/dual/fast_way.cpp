#include "geom/dual/fast_way.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

using margin::more;

}  // namespace

// --- removal -------------------------------------------------------------------------------------

bool FastWay::plan(SiteId p) {
  around_.strangers.forget();
  if (state_.corners.types() == CornerTypes::all) return false;
  if (state_.shapes[p] == CellShape::unknown) certify(p);
  around_.p = p;
  return state_.shapes[p] == CellShape::regular && around_.rim.open_star(state_, p) && hole_.plan();
}

void FastWay::remove(DualChange& change) {
  erase_inside(change);
  fill_hole(change);
  hole_.raise_reaches();
  state_.leave(around_.p);
  state_.reach.forget(around_.p);
  name_rim(change);
}

void FastWay::erase_inside(DualChange& change) {
  for (const CircleId c : around_.rim.inside()) {
    state_.circles.erase(c);
    change.circles_erased.push_back(c);
  }
}

/// Joins the circles of the hole to each other and to those beyond the rim.
void FastWay::fill_hole(DualChange& change) {
  const Rim& rim = around_.rim;
  const std::size_t first = change.circles_created.size();
  for (const EmptyCircle& circle : circles()) change.circles_created.push_back(state_.circles.create(circle));
  const auto id = [&](std::size_t i) { return change.circles_created[first + i]; };
  for (std::size_t i = 0; i < circles().size(); ++i)
    for (std::size_t e = 0; e < 3; ++e) {
      const Hole::Triangle& triangle = hole_.triangles()[i];
      const int beyond = triangle.beyond[e], j = -1 - beyond;
      const CircleId other = beyond >= 0 ? id(static_cast<std::size_t>(beyond)) : rim.outer(j);
      state_.circles.set_beyond(id(i), state_.circles[id(i)].index_of(rim[triangle.corners[e]]), other);
      if (beyond < 0)
        state_.circles.set_beyond(other, state_.circles[other].opposite(rim[j], rim[rim.next(j)]), id(i));
    }
}

void FastWay::name_rim(DualChange& change) const {
  change.cells.assign(rim().begin(), rim().end());
  std::ranges::sort(change.cells);
}

// --- a move that keeps its rim -------------------------------------------------------------------

bool FastWay::move_in_place(std::size_t circle, const WeightedPoint3& point, DualChange& change) {
  const SiteId p = around_.p;
  const WeightedPoint3 old = state_.sites[p];
  if (point.weight != old.weight && state_.leeways.is_in_use()) return false;
  state_.search.allow(point.weight);
  Frame& frame = around_.frame;
  const Rim& rim = around_.rim;
  frame.add(point);
  around_.vertices.follow();
  around_.self = rim.size();
  const Frame::Seen seen = frame.seen(around_.self);
  for (const Hole::Triangle& triangle : hole_.triangles())
    if (!frame.difference(triangle.values, seen, triangle.corners[0]).negative()) return false;
  state_.sites[p] = point;
  const FacetId home = hole_.triangles()[circle].facet();
  if (!prove_in_place(home, old)) {
    state_.sites[p] = old;
    return false;
  }
  had_leeway_ = around_.leeway;
  state_.follow(p, old.position);
  state_.home[p] = home;
  raise_reaches(old);
  for (int j = 0; j < rim.size(); ++j) {
    const CellProof::Corner& corner = cell_.corners()[static_cast<std::size_t>(j)];
    const CornerCircles::Place place =
        state_.corners.place_of(corner.point.position, corner.facet, state_.circles[rim.inner(j)].sites[0]);
    state_.circles.move(rim.inner(j), place.center, place.radius2, corner.facet);
    change.circles_moved.push_back(rim.inner(j));
  }
  state_.reach.set(p, cell_.reach());
  name_rim(change);
  return true;
}

/// p is at its new place, but not in the search.
bool FastWay::prove_in_place(FacetId home, const WeightedPoint3& old) {
  if (!around_.leeway && cell_.beats_outer_circle()) return false;
  hole_corners_.clear();
  for (const Flood::Corner& corner : around_.flood.corners())
    hole_corners_.push_back({around_.on_surface(corner), around_.frame.power(corner.at, corner.site)});
  around_.flood.clear();
  const double way = around_.frame.offset(around_.self).norm() + std::abs(around_.frame.rise(around_.self));
  const double least_distance =
      (state_.distance_at(reach(), around_.p) + way) * more;  // the hole is in this ball
  return cell_.prove_new({home, old, least_distance});
}

/// Of the rim, by what it won: that lies between the old border of p and the new one, and is divided by what
/// is left of the edges of the hole.
void FastWay::raise_reaches(const WeightedPoint3& old) {
  const WeightedPoint3& site = around_.site();
  const Rim& rim = around_.rim;
  for (int j = 0; hole_.is_on_sheet() && j < rim.size(); ++j) {
    const SiteId left = rim[j], right = rim[rim.next(j)];
    state_.reach.raise(left, around_.on_sheet ? cell_.arcs()[static_cast<std::size_t>(j)] : cell_.reach());
    const EmptyCircle& was = state_.circles[rim.inner(j)];
    if (around_.power_at(around_.on_surface(was), site) <= was.radius2)
      continue;  // else the edge goes on inwards
    const CellProof::Corner& is = cell_.corners()[static_cast<std::size_t>(j)];
    const Vec3 &start = was.center, &end = is.point.position;
    const WeightedPoint3 &of_left = state_.sites[left], &of_right = state_.sites[right];
    double power = around_.power_along(of_left, start, end, hole_.steepest());  // to both
    if (!(power < infinity)) {
      const double far2 =
          extent_of_edge(state_.mesh, of_left, of_right, {was.facet, is.facet, start, end}).far2;
      power = around_.with_tolerance(far2) - of_left.weight;
    }
    power = std::min(power, max_radius2());
    state_.reach.raise(left, power);
    state_.reach.raise(right, power);
  }
  if (hole_.is_on_sheet()) return;
  double power = std::max(reach(), cell_.reach());
  for (const auto& [z, without_p] : hole_corners_)
    if (around_.power_at(z, site) > without_p) {
      const double weight = -old.weight;  // any will do: the power is turned into a distance and back
      const double far = std::sqrt(std::max(0.0, without_p - weight)) + z.off;
      power = std::max(power, far * far * more + weight);
    }
  for (const SiteId r : rim.sites()) state_.reach.raise(r, power);
}

// --- insertion -----------------------------------------------------------------------------------

bool FastWay::insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId first,
                     DualChange& change) {
  if (state_.corners.types() == CornerTypes::all) return false;
  around_.p = p;
  around_.self = Frame::none;
  around_.forget();
  state_.admit(p, point);
  if (!around_.rim.find_conflict(state_, point, first)) return false;
  double far2 = 0;
  for (const CircleId c : around_.rim.inside())
    far2 = std::max(far2, around_.distance2(around_.on_surface(state_.circles[c]), point));
  if (!cell_.prove_new({home, point, std::sqrt(around_.with_tolerance(far2))})) return false;
  erase_inside(change);
  make_star(change);
  state_.enter(p);
  state_.home[p] = home;
  state_.reach.set(p, cell_.reach());
  state_.set_shape(p, CellShape::regular);
  for (const SiteId r : rim()) lower_reach(r);
  name_rim(change);
  return true;
}

/// The circles of p and two neighbours on the rim, joined to each other and to those beyond.
void FastWay::make_star(DualChange& change) {
  const Rim& rim = around_.rim;
  const std::size_t created = change.circles_created.size();
  for (int j = 0; j < rim.size(); ++j) {
    const CellProof::Corner& corner = cell_.corners()[static_cast<std::size_t>(j)];
    change.circles_created.push_back(state_.circles.create(state_.corners.circle_of(
        {around_.p, rim[j], rim[rim.next(j)]}, corner.facet, corner.point.position)));
  }
  const auto id = [&](int j) { return change.circles_created[created + static_cast<std::size_t>(j)]; };
  for (int j = 0; j < rim.size(); ++j) {
    const EmptyCircle& circle = state_.circles[id(j)];
    const SiteId a = rim[j], b = rim[rim.next(j)];
    const CircleId outer = rim.outer(j);
    state_.circles.set_beyond(id(j), circle.index_of(around_.p), outer);
    state_.circles.set_beyond(id(j), circle.index_of(a), id(rim.next(j)));
    state_.circles.set_beyond(id(j), circle.index_of(b), id(rim.previous(j)));
    state_.circles.set_beyond(outer, state_.circles[outer].opposite(a, b), id(j));
  }
}

/// Of a regular site whose cell became smaller: from the edges around it, if they are on a sheet that goes on
/// beyond them. Counterclockwise around the site they have its cell inside, where nothing is farther
/// (chart.h).
void FastWay::lower_reach(SiteId r) {
  const WeightedPoint3& site = state_.sites[r];
  const Sheet* sheet = around_.sheets.known(r, site.level);
  if (state_.shapes[r] != CellShape::regular || !sheet) return;
  double far2 = 0;
  Vec3 twice_area(0, 0, 0);
  for (const CircleId c : state_.circles.of_site(r)) {
    const EmptyCircle& from = state_.circles[c];
    if (!state_.is_level(from, site.level)) return;
    const std::size_t i = from.index_of(r);
    const EmptyCircle& to = state_.circles[from.beyond[from.after(i)]];
    const TracedEdge::Extent extent =
        extent_of_edge(state_.mesh, site, state_.sites[from.sites[from.before(i)]],
                       {from.facet, to.facet, from.center, to.center});
    far2 = std::max(far2, extent.far2);
    twice_area += extent.twice_area;
  }
  far2 = around_.with_tolerance(far2);
  if (!(far2 - site.weight < state_.reach[r]) || !sheet->covers(site.position, std::sqrt(far2)) ||
      !(twice_area.dot(sheet->axis) > 1e-6 * far2))
    return;
  state_.reach.set(r, far2 - site.weight);
}

// --- regular sites -------------------------------------------------------------------------------

void FastWay::certify(SiteId p) {
  around_.p = p;
  around_.forget();
  const bool is_regular = state_.corners.types() != CornerTypes::all && state_.home[p].valid() &&
                          around_.rim.open_star(state_, p) && cell_.prove_present();
  if (is_regular) state_.reach.set(p, std::min(state_.reach[p], cell_.reach()));
  state_.set_shape(p, is_regular ? CellShape::regular : CellShape::irregular);
}

void FastWay::certify(SiteId p, const KnownCell& known) {
  around_.sheets.keep(p, known.sheet);
  state_.leeways.set_way(p, known.way);
  if (known.shape == CellShape::unknown || state_.corners.types() == CornerTypes::all) return certify(p);
  state_.set_shape(p, known.shape);
}

KnownCell FastWay::known(SiteId p) const {
  const Sheet* sheet = around_.sheets.known(p, state_.sites[p].level);
  return {state_.shapes[p], state_.leeways.way(p), sheet ? *sheet : Sheet()};
}

}  // namespace geom
