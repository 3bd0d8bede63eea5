// The other half of the fast way: p comes to its new place.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/dual/fast_way.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double more = 1 + 1e-9;  // for the rounding of distances
constexpr std::size_t few = 40;    // sites are looked at one by one

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

bool FastWay::move_in_place(std::size_t circle, const WeightedPoint3& point, DualChange& change) {
  const WeightedPoint3 old = state_.sites[p_];
  const double reach_before = reach_;
  frame_.add_late(point);
  self_ = size();
  const Vec3 d = frame_.offset(self_);
  const double c = frame_.constant(self_);
  for (const Triangle& triangle : triangles_)
    if (!frame_.difference(triangle.values, d, c, triangle.corners[0]).negative()) return false;
  state_.sites[p_] = point;
  const FacetId home = triangles_[circle].facet;
  const auto is_proven = [&] {
    for (const CircleId o : outer_)
      if (!lead_at(state_.circles[o]).positive()) return false;
    hole_corners_.clear();
    for (const Flood::Corner& corner : flood_.corners())
      hole_corners_.push_back(
          {corner.y + old.position, frame_.power(corner.y, corner.site), corner.tolerance});
    starts_.clear();
    for (const CircleId s : star_) starts_.push_back(state_.circles[s].facet);
    const double least_distance = (state_.distance_at(reach_before, p_) + d.norm()) * more;  // H is in this ball
    return prove_new_cell(home, least_distance, star_);
  };
  if (!is_proven()) {
    state_.sites[p_] = old;
    return false;
  }
  state_.follow(p_, old.position);
  state_.home[p_] = home;
  const double gained = power_gained(old, reach_before);
  for (int j = 0; j < size(); ++j) {
    EmptyCircle moved = state_.circles[star_[at(j)]];
    moved.facet = corners_[at(j)].facet;
    state_.center_circle(moved, corners_[at(j)].point.position);
    state_.circles.move(star_[at(j)], moved.center, moved.radius2, moved.facet);
    change.circles_moved.push_back(star_[at(j)]);
  }
  state_.set_reach(p_, cell_reach_);
  for (const SiteId r : rim_) state_.raise_reach(r, gained);
  change.cells = rim_;
  std::ranges::sort(change.cells);
  return true;
}

/// A bound of the power where the rim won something: between the old border of p_, the new one, and on what is left of
/// edges of the hole.
double FastWay::power_gained(const WeightedPoint3& old, double reach_before) const {
  double power = std::max(reach_before, cell_reach_);
  if (was_on_sheet_ && !on_sheet_) return std::max(power, max_radius2_);
  for (int j = 0; on_sheet_ && was_on_sheet_ && j < size(); ++j) {  // what is left of an edge of the hole
    const WeightedPoint3& r = state_.sites[rim_[at(j)]];
    const double far2 =
        chart_.farthest2(j, next(j), corners_[at(j)].point.position - r.position,
                         state_.circles[star_[at(j)]].center - r.position);
    power = std::max(power, with_tolerance(far2) - r.weight);
  }
  for (const auto& [z, without_p, off] : hole_corners_)
    if (geom::power(z, state_.sites[p_]) > without_p) {
      const double weight = -old.weight;  // any will do: the power is turned into a distance and back
      const double far = std::sqrt(std::max(0.0, without_p - weight)) + off;
      power = std::max(power, far * far * more + weight);
    }
  return power;
}

/// p_ is at its new place, but not in the tree; the rim and the facets to start from are known. Locations that p_ may win
/// are within that distance, or were someone else's.
bool FastWay::prove_new_cell(FacetId home, double least_distance, std::span<const CircleId> reached) {
  was_on_sheet_ = on_sheet_;
  if (!find_star_corners()) return false;
  if (state_.paper) state_.paper->insert(p_, state_.sites[p_], rim_.front());
  const auto prove = [&] {
    if (may_beat_unreached(reached)) return false;
    const double distance =
        state_.distance_at(std::max(power_bound_at_corners(), power_of_rivals()), p_);
    on_sheet_ = enclose_on_sheet(home, distance, least_distance);
    if (on_sheet_) return true;
    return trace_cell(home) &&
           has_one_component(std::max({least_distance, distance, state_.distance_at(cell_reach_, p_)}));
  };
  if (prove()) return true;
  if (state_.paper) state_.paper->remove(p_);
  return false;
}

/// Of p_ at the corners of its new cell.
double FastWay::power_bound_at_corners() const {
  double far2 = 0;
  for (const StarCorner& corner : corners_)
    far2 = std::max(far2, (corner.point.position - state_.sites[p_].position).squaredNorm());
  return with_tolerance(far2) - state_.sites[p_].weight;
}

/// Of the new cell of p_, empty but for strangers.
bool FastWay::find_star_corners() {
  if (self_ == Frame::none) {
    frame_.begin(state_.sites[p_]);
    for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  }
  corners_.clear();
  Frame::Values values;
  for (int j = 0; j < size(); ++j) {
    const FacetId t = walk(self_, j, next(j), starts_[at(j)]);
    if (!t.valid()) return false;
    std::array<SiteId, 3> sites{p_, rim_[at(j)], rim_[at(next(j))]};
    std::ranges::sort(sites);
    const RoundedPoint point = state_.clipper.meeting(t, sites);
    frame_.evaluate(point.position - frame_.origin().position, point.tolerance, values);
    for (int i = 0; i < size(); ++i)
      if (i != j && i != next(j) && !values.nearer(self_, i)) return false;
    corners_.push_back({t, point});
  }
  return true;
}

/// Is the new cell of p_ what its corners say (chart.h), and all that p_ has within that distance? And within the other
/// one, if the hole is not on this sheet. Sets cell_reach_.
bool FastWay::enclose_on_sheet(FacetId home, double distance, double elsewhere) {
  const WeightedPoint3& site = state_.sites[p_];
  if (!home.valid()) return false;
  const Vec3 middle = site.position - frame_.origin().position;
  if (on_sheet_ && sheet_.covers(site.position, distance)) {
    chart_.replace(size(), frame_.offset(self_), frame_.constant(self_));
  } else {
    distance = std::max(distance, elsewhere);
    const Sheet* sheet = sheets_.around(p_, site.position, distance);
    if (!sheet) return false;
    chart_sites(*sheet);
  }
  double own2 = 0;
  points_.clear();
  for (int j = 0; j < size(); ++j) {
    points_.push_back(corners_[at(j)].point);
    own2 = std::max(own2, chart_.farthest2(size(), j, corners_[at(previous(j))].point.position - site.position,
                                             corners_[at(j)].point.position - site.position));
  }
  own2 = with_tolerance(own2);
  const double own = std::sqrt(own2) * more;
  if (!sheet_.covers(site.position, std::max(distance, own))) return false;
  if (!chart_.is_simple_with(size(), own + middle.norm())) return false;
  link_.clear();
  for (int j = 0; j < size(); ++j)
    link_.push_back({frame_.offset(j) - middle, Frame::constant(state_.sites[rim_[at(j)]], site)});
  if (!Sheets::has_one_component(sheet_, own, link_)) return false;
  cell_reach_ = own2 - site.weight;
  return no_stranger_in_cell(own);
}

/// Sets cell_reach_. `home`: a facet with the location of p_.
bool FastWay::trace_cell(FacetId home) {
  frame_.begin(state_.sites[p_]);
  self_ = Frame::none;
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  facets_.clear();
  points_.clear();
  for (const StarCorner& corner : corners_) {
    facets_.push_back(corner.facet);
    points_.push_back(corner.point);
  }
  if (!home.valid() || !flood_.trace(facets_, false) || !flood_.meets(home)) return false;
  for (int j = 0; j < size(); ++j)
    if (!flood_.add_end(corners_[at(j)].facet, j, Frame::none) ||
        !flood_.add_end(corners_[at(j)].facet, next(j), Frame::none))
      return false;
  if (!flood_.is_complete()) return false;
  const WeightedPoint3& site = state_.sites[p_];
  double radius2 = flood_.radius2();
  for (const RoundedPoint& point : points_) {
    const double far = (point.position - site.position).norm() + point.tolerance;
    radius2 = std::max(radius2, far * far);
  }
  cell_reach_ = radius2 * more - site.weight;
  return no_stranger_in_cell(std::sqrt(radius2 * more));
}

bool FastWay::no_stranger_in_cell(double radius) {
  const Vacancy cell{p_, state_.sites[p_].position, radius, cell_reach_};
  if (state_.paper) {
    candidates_.clear();
    state_.paper->rivals(p_, candidates_);
  } else if (!knows(cell.center, cell.radius + state_.distance_at(cell_reach_))) {
    candidates_.clear();
    look_around(cell);
  }
  return is_empty_of_strangers(cell, points_, {});
}

/// May p_ beat circles that are not reached? They would be of an irregular site.
bool FastWay::may_beat_unreached(std::span<const CircleId> reached) {
  const WeightedPoint3& point = state_.sites[p_];
  std::span<const SiteId> suspects = state_.not_regular();
  if (suspects.size() > few) {
    rivals_.clear();
    state_.tree.rivals(point, rivals_);
    std::erase_if(rivals_, [&](SiteId s) { return state_.shape(s) == DualState::Shape::regular; });
    suspects = rivals_;
  }
  return std::ranges::any_of(suspects, [&](SiteId s) {
    const double far = state_.distance_at(state_.reach[s], s) + state_.distance_at(state_.reach[s], p_);
    if (s == p_ || (state_.sites[s].position - point.position).squaredNorm() > far * far * more) return false;
    const std::span<const CircleId> circles = state_.circles.of_site(s);
    return circles.empty() || std::ranges::any_of(circles, [&](CircleId c) {
             return std::ranges::find(reached, c) == reached.end() && !lead_at(state_.circles[c]).positive();
           });
  });
}

/// The power of the center to p_, at its new place, less that to the sites of the circle.
Sure FastWay::lead_at(const EmptyCircle& circle) const {
  const WeightedPoint3& point = state_.sites[p_];
  const double there2 = (circle.center - point.position).squaredNorm();
  const double own2 = (circle.center - state_.sites[circle.sites[0]].position).squaredNorm();
  const double scale = there2 + own2 + std::abs(point.weight) + std::abs(circle.radius2);
  return {there2 - point.weight - circle.radius2,
          0x1p-48 * scale + 8 * state_.clipper.most_tolerance() * std::sqrt(there2 + own2)};
}

/// Has the cell that was traced all that p_ owns within that distance? By the shape of the surface, or else by looking at
/// each facet there that the cell does not meet.
bool FastWay::has_one_component(double distance) {
  const Vec3& p = state_.sites[p_].position;
  link_.clear();
  for (int j = 0; j < size(); ++j) link_.push_back({frame_.offset(j), frame_.constant(j)});
  const Sheet* sheet = sheets_.around(p_, p, distance);
  if (sheet && Sheets::has_one_component(*sheet, state_.distance_at(cell_reach_, p_), link_)) return true;
  candidates_.clear();
  known_radius_ = -1;
  cell_power_ = distance * distance - state_.sites[p_].weight;
  return std::ranges::all_of(sheets_.facets_within(p, distance), [&](FacetId t) {
    return flood_.meets(t) || !state_.clipper.comes_near(t, p, distance) || owns_nothing_of(t);
  });
}

/// Is some site nearer than p_, everywhere on the facet? Mostly it is one and the same at all three corners. Else the facet
/// is clipped, in doubles, by those who are nearer somewhere, and what is left kept a little too large.
bool FastWay::owns_nothing_of(FacetId t) {
  const TriMesh::Facet& corners = state_.mesh.facet(t);
  const Frame::Slot s0 = frame_.with_signs(corners[0]), s1 = frame_.with_signs(corners[1]),
                    s2 = frame_.with_signs(corners[2]);
  const Frame::Vertex &v0 = frame_.vertex(s0), &v1 = frame_.vertex(s1), &v2 = frame_.vertex(s2);
  if (v0.sure && v1.sure && v2.sure && (v0.beaten_by & v1.beaten_by & v2.beaten_by) != 0) return true;
  part_ = {v0.y, v1.y, v2.y};
  const double most = std::max({v0.y.norm(), v1.y.norm(), v2.y.norm()});
  for (int j = 0; j < this->size(); ++j)
    if (keep_part(frame_.offset(j), frame_.constant(j), most)) return true;
  if (candidates_.empty()) {  // another sheet: who else is there?
    const double radius = state_.distance_at(cell_power_, p_);
    state_.near({p_, state_.sites[p_].position, radius, cell_power_}, candidates_);
  }
  return std::ranges::any_of(candidates_, [&](SiteId s) {
    if (s == p_) return false;
    const WeightedPoint3 &site = state_.sites[s], &origin = frame_.origin();
    return keep_part(Frame::offset(site, origin), Frame::constant(site, origin), most);
  });
}

/// Clips part_ to where a site, given by its d and c, is not nearer than p_. True if nothing is left. `size` bounds all
/// |y|; what rounding may have misplaced, by far less than a 2^-40th of it, is kept.
bool FastWay::keep_part(const Vec3& d, double c, double size) {
  const double length = d.norm(), slack = 0x1p-40 * (length * (size + length) + std::abs(c));
  const auto value = [&](const Vec3& y) { return c - 2 * d.dot(y) + slack; };
  clipped_.clear();
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const Vec3 &a = part_[i], &b = part_[i + 1 == part_.size() ? 0 : i + 1];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) clipped_.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) clipped_.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  part_.swap(clipped_);
  return part_.empty();
}

bool FastWay::insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId first,
                     DualChange& change) {
  if (state_.types == CornerTypes::all) return false;
  p_ = p;
  self_ = Frame::none;
  on_sheet_ = false;
  known_radius_ = -1;
  state_.admit(p, point);
  if (!find_conflict(first) || !prove_new_cell(home, 0, conflict_)) return false;
  for (const CircleId c : conflict_) {
    state_.circles.erase(c);
    change.circles_erased.push_back(c);
  }
  const std::size_t created = change.circles_created.size();
  for (int j = 0; j < size(); ++j)
    change.circles_created.push_back(state_.circles.create(
        circle_of({p, rim_[at(j)], rim_[at(next(j))]}, corners_[at(j)].facet, corners_[at(j)].point)));
  const auto id = [&](int j) { return change.circles_created[created + at(j)]; };
  for (int j = 0; j < size(); ++j) {
    const EmptyCircle& circle = state_.circles[id(j)];
    const SiteId a = rim_[at(j)], b = rim_[at(next(j))];
    state_.circles.set_beyond(id(j), circle.index_of(p), outer_[at(j)]);
    state_.circles.set_beyond(id(j), circle.index_of(a), id(next(j)));
    state_.circles.set_beyond(id(j), circle.index_of(b), id(previous(j)));
    state_.circles.set_beyond(outer_[at(j)], state_.circles[outer_[at(j)]].opposite(a, b), id(j));
  }
  state_.enter(p);
  state_.home[p] = home;
  state_.set_reach(p, cell_reach_);
  state_.set_shape(p, DualState::Shape::regular);
  for (const CircleId c : conflict_)
    for (const SiteId s : state_.circles[c].sites)  // who has lost all is hidden now
      if (s != p && state_.circles.of_site(s).empty() && state_.reach[s] > -infinity)
        state_.set_reach(s, -infinity);
  change.cells = rim_;
  std::ranges::sort(change.cells);
  return true;
}

/// The circles that p_ beats, from one of them on, and the cycle of edges around them: rim_, outer_, starts_.
bool FastWay::find_conflict(CircleId first) {
  struct Edge {
    SiteId a, b;
    CircleId outer, inner;
  };
  std::array<Edge, 3 * most> edges;
  std::size_t num_edges = 0;
  conflict_.assign(1, first);
  if (!lead_at(state_.circles[first]).negative()) return false;
  for (std::size_t n = 0; n < conflict_.size(); ++n) {
    const EmptyCircle circle = state_.circles[conflict_[n]];
    for (std::size_t i = 0; i < 3; ++i) {
      const CircleId other = circle.beyond[i];
      if (!other.valid()) return false;
      if (std::ranges::find(conflict_, other) != conflict_.end()) continue;
      const Sure found = lead_at(state_.circles[other]);
      if (!found.certain()) return false;
      if (found.value < 0) {
        if (conflict_.size() == 2 * most) return false;
        conflict_.push_back(other);
      } else {
        if (num_edges == edges.size()) return false;
        edges[num_edges++] = {circle.sites[circle.after(i)], circle.sites[circle.before(i)], other,
                              conflict_[n]};
      }
    }
  }
  if (num_edges != conflict_.size() + 2 || num_edges > most) return false;
  rim_.clear();
  outer_.clear();
  starts_.clear();
  std::size_t edge = 0;
  for (std::size_t j = 0; j < num_edges; ++j) {
    if (std::ranges::find(rim_, edges[edge].a) != rim_.end()) return false;
    rim_.push_back(edges[edge].a);
    outer_.push_back(edges[edge].outer);
    starts_.push_back(state_.circles[edges[edge].inner].facet);
    const SiteId b = edges[edge].b;
    edge = static_cast<std::size_t>(std::find_if(edges.begin(),
                                                 edges.begin() + static_cast<std::ptrdiff_t>(num_edges),
                                                 [&](const Edge& e) { return e.a == b; }) -
                                    edges.begin());
    if (edge == num_edges) return false;
  }
  return edge == 0;
}

// --- regular sites -------------------------------------------------------------------------------

void FastWay::certify(SiteId p) {
  state_.set_shape(p, is_regular(p) ? DualState::Shape::regular : DualState::Shape::irregular);
}

bool FastWay::is_regular(SiteId p) {
  known_radius_ = -1;
  if (state_.types == CornerTypes::all || !state_.home[p].valid() || !open_star(p)) return false;
  frame_.begin(state_.sites[p]);
  self_ = Frame::none;
  on_sheet_ = false;
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  corners_.clear();
  for (const CircleId c : star_)
    corners_.push_back(
        {state_.circles[c].facet, {state_.circles[c].center, 2 * state_.clipper.most_tolerance()}});
  const double known = state_.distance_at(state_.reach[p], p);
  on_sheet_ = enclose_on_sheet(state_.home[p], known, known);
  if (!on_sheet_ && (!trace_cell(state_.home[p]) || !has_one_component(known))) return false;
  state_.set_reach(p, std::min(state_.reach[p], cell_reach_));
  return true;
}

}  // namespace geom
