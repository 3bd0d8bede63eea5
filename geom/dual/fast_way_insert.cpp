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
constexpr double ampler = 1.15;    // a cell than its corners
constexpr double bend = 1.1;       // of an edge does not matter
constexpr double widest = 1.35;    // in radii of a cell: the distance for which a sheet is made

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

bool FastWay::move_in_place(std::size_t circle, const WeightedPoint3& point, DualChange& change) {
  const WeightedPoint3 old = old_ = state_.sites[p_];
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
      if (!state_.lead_at(state_.circles[o], point).positive()) return false;
    hole_corners_.clear();
    for (const Flood::Corner& corner : flood_.corners())
      hole_corners_.push_back(
          {corner.y + old.position, frame_.power(corner.y, corner.site), corner.tolerance});
    flood_.clear();
    starts_.clear();
    for (const CircleId s : star_) starts_.push_back(state_.circles[s].facet);
    const double least_distance =
        (state_.distance_at(reach_before, p_) + d.norm()) * more;  // H is in this ball
    return prove_new_cell(home, least_distance, star_);
  };
  if (!is_proven()) {
    state_.sites[p_] = old;
    return false;
  }
  state_.follow(p_, old.position);
  state_.home[p_] = home;
  raise_reaches(old, reach_before);
  for (int j = 0; j < size(); ++j) {
    EmptyCircle moved = state_.circles[star_[at(j)]];
    moved.facet = corners_[at(j)].facet;
    state_.center_circle(moved, corners_[at(j)].point.position);
    state_.circles.move(star_[at(j)], moved.center, moved.radius2, moved.facet);
    change.circles_moved.push_back(star_[at(j)]);
  }
  state_.set_reach(p_, cell_reach_);
  change.cells = rim_;
  std::ranges::sort(change.cells);
  return true;
}

/// Of the rim, by what it won: that lies between the old border of p_ and the new one, and is divided by what
/// is left of the edges of the hole.
void FastWay::raise_reaches(const WeightedPoint3& old, double reach_before) {
  const WeightedPoint3& site = state_.sites[p_];
  for (int j = 0; hole_on_sheet_ && j < size(); ++j) {
    const SiteId left = rim_[at(j)], right = rim_[at(next(j))];
    state_.raise_reach(left, on_sheet_ ? arc_[at(j)] : cell_reach_);
    const EmptyCircle& was = state_.circles[star_[at(j)]];
    if (geom::power(was.center, site) <= was.radius2) continue;  // else the edge goes on inwards
    const double far2 =
        extent_of_edge(state_.mesh, state_.sites[left], state_.sites[right],
                       {was.facet, corners_[at(j)].facet, was.center, corners_[at(j)].point.position})
            .far2;
    const double power = std::min(with_tolerance(far2) - state_.sites[left].weight, max_radius2_);
    state_.raise_reach(left, power);
    state_.raise_reach(right, power);
  }
  if (hole_on_sheet_) return;
  double power = std::max(reach_before, cell_reach_);
  for (const auto& [z, without_p, off] : hole_corners_)
    if (geom::power(z, site) > without_p) {
      const double weight = -old.weight;  // any will do: the power is turned into a distance and back
      const double far = std::sqrt(std::max(0.0, without_p - weight)) + off;
      power = std::max(power, far * far * more + weight);
    }
  for (const SiteId r : rim_) state_.raise_reach(r, power);
}

/// p_ is at its new place, but not in the tree; the rim and the facets to start from are known. `reached`:
/// the circles that p_ beats, or had before. They, and what was not someone else's, are within that distance.
bool FastWay::prove_new_cell(FacetId home, double least_distance, std::span<const CircleId> reached) {
  if (!home.valid() || !find_star_corners()) return false;
  if (state_.paper) state_.paper->insert(p_, state_.sites[p_], rim_.front());
  const auto prove = [&] {
    if (may_beat_unreached(reached)) return false;
    cell_reach_ = power_bound_at_corners();
    const double own = state_.distance_at(cell_reach_, p_);
    if (!no_stranger_in_cell(ampler * own)) return false;
    const double all = state_.distance_at(std::max(cell_reach_, state_.largest_reach()), p_);
    const bool is_all_near = on_sheet_ && sheet_.covers(state_.sites[p_].position, all);
    far_rivals_.clear();
    if (!is_all_near) find_far_rivals(own);
    const double farthest = far_rivals_.empty() ? own : far_rivals_.front().distance;
    double least = farthest <= widest * own ? farthest : own;
    on_sheet_ = on_sheet_ && sheet_.covers(state_.sites[p_].position, least);
    if (!on_sheet_) least = std::max(least, least_distance);  // the hole was not proven on that sheet
    on_sheet_ = chart_around(least);
    if (on_sheet_) {
      const double near = sheet_.distance_from(state_.sites[p_].position);
      on_sheet_ = distance_to_search(near, reached) <= near && enclose_on_sheet(least);
    }
    if (on_sheet_) return true;
    if (!trace_cell(home)) return false;
    if (is_all_near) find_far_rivals(own);
    const double near = std::max({own, least_distance, state_.distance_at(cell_reach_, p_)});
    return has_one_component(distance_to_search(near, reached));
  };
  if (prove()) return true;
  if (state_.paper) state_.paper->remove(p_);
  return false;
}

/// Those who may lose something farther from p_ than that, the farthest first.
void FastWay::find_far_rivals(double distance) {
  far_rivals_.clear();
  suspects_.clear();
  strangers_.find_rivals_beyond(distance * distance - state_.sites[p_].weight, p_, suspects_);
  for (const SiteId s : suspects_) far_rivals_.push_back({state_.distance_at(state_.reach[s], p_), s});
  std::ranges::sort(far_rivals_,
                    [](const FarRival& a, const FarRival& b) { return a.distance > b.distance; });
}

/// All that p_ has is known if its cell is, within that distance: not less than `near`, for which it is so of
/// what hangs together with a reached circle.
double FastWay::distance_to_search(double near, std::span<const CircleId> reached) {
  for (const FarRival& rival : far_rivals_) {
    if (rival.distance <= near) break;
    if (!losses_.hang_together(rival.site, {p_, state_.sites[p_], old_}, reached)) return rival.distance;
  }
  return near;
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

/// Puts the rim and p_ into a chart that covers that distance around it.
bool FastWay::chart_around(double distance) {
  const Vec3& place = state_.sites[p_].position;
  if (on_sheet_ && sheet_.covers(place, distance)) {
    chart_.replace(size(), frame_.offset(self_), frame_.constant(self_));
    return true;
  }
  const Sheet* sheet = sheets_.around(p_, place, distance);
  if (sheet) chart_sites(*sheet);
  return sheet;
}

/// Is the new cell of p_ what its corners say (chart.h), and all that p_ has where the chart is, at least
/// within that distance? Sets cell_reach_.
bool FastWay::enclose_on_sheet(double distance) {
  const WeightedPoint3& site = state_.sites[p_];
  const Vec3& origin = frame_.origin().position;
  const double enough = bend * (power_bound_at_corners() + site.weight);
  double own2 = 0;
  arc_.clear();
  for (int j = 0; j < size(); ++j) {
    const StarCorner &from = corners_[at(previous(j))], &to = corners_[at(j)];
    const double far2 = with_tolerance(farthest2(
        {self_, j, from.facet, to.facet, from.point.position - origin, to.point.position - origin}, enough));
    arc_.push_back(far2 - site.weight);
    own2 = std::max(own2, far2);
  }
  const Vec3 middle = site.position - frame_.origin().position;
  const double own = std::sqrt(own2) * more, radius = own + middle.norm();
  if (!sheet_.covers(site.position, std::max(distance, own)) || !chart_.is_simple_with(size(), radius))
    return false;
  link_.clear();
  for (int j = 0; j < size(); ++j)
    link_.push_back({frame_.offset(j) - middle, Frame::constant(state_.sites[rim_[at(j)]], site)});
  if (!Sheets::has_one_component(sheet_, own, link_)) return false;
  cell_reach_ = own2 - site.weight;
  return (own <= kept_radius_ || no_stranger_in_cell(own)) && is_simple_with_strangers(radius);
}

/// Sets cell_reach_. `home`: a facet with the location of p_.
bool FastWay::trace_cell(FacetId home) {
  frame_.begin(state_.sites[p_]);
  self_ = Frame::none;
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  facets_.clear();
  for (const StarCorner& corner : corners_) facets_.push_back(corner.facet);
  if (!flood_.trace(facets_, false) || !flood_.meets(home)) return false;
  for (int j = 0; j < size(); ++j)
    if (!flood_.add_end(corners_[at(j)].facet, j, Frame::none) ||
        !flood_.add_end(corners_[at(j)].facet, next(j), Frame::none))
      return false;
  if (!flood_.is_complete()) return false;
  const WeightedPoint3& site = state_.sites[p_];
  double radius2 = flood_.radius2();
  for (const StarCorner& corner : corners_) {
    const double far = (corner.point.position - site.position).norm() + corner.point.tolerance;
    radius2 = std::max(radius2, far * far);
  }
  cell_reach_ = radius2 * more - site.weight;
  return no_stranger_in_cell(std::sqrt(radius2 * more));
}

/// Are the sites beyond the rim farther at all corners of the cell, and at those of the flood? The cell is in
/// that ball.
bool FastWay::no_stranger_in_cell(double radius) {
  const WeightedPoint3& site = state_.sites[p_];
  kept_radius_ = radius;
  strangers_.find_rivals(p_, site.position, radius);
  strangers_.keep_near(frame_, p_, rim_, {site.position - frame_.origin().position, radius}, self_);
  const auto is_p_nearest = [&](const Vec3& z, double off) { return strangers_.are_beyond(z, site, off); };
  return std::ranges::all_of(
             corners_,
             [&](const StarCorner& c) { return is_p_nearest(c.point.position, c.point.tolerance); }) &&
         std::ranges::all_of(flood_.corners(), [&](const Flood::Corner& c) {
           return is_p_nearest(c.y + frame_.origin().position, c.tolerance);
         });
}

/// May p_ beat circles that are not reached? They would be of an irregular site.
bool FastWay::may_beat_unreached(std::span<const CircleId> reached) {
  if (state_.not_regular().empty()) return false;
  const WeightedPoint3& point = state_.sites[p_];
  suspects_.clear();
  state_.irregular_rivals(p_, suspects_);
  return std::ranges::any_of(suspects_, [&](SiteId s) {
    const double far = state_.distance_at(state_.reach[s], s) + state_.distance_at(state_.reach[s], p_);
    if (s == p_ || (state_.sites[s].position - point.position).squaredNorm() > far * far * more) return false;
    const std::span<const CircleId> circles = state_.circles.of_site(s);
    return circles.empty() || std::ranges::any_of(circles, [&](CircleId c) {
             return std::ranges::find(reached, c) == reached.end() &&
                    !state_.lead_at(state_.circles[c], point).positive();
           });
  });
}

/// Has the cell that was traced all that p_ owns within that distance? By the shape of the surface, or else
/// by looking at each facet there that the cell does not meet.
bool FastWay::has_one_component(double distance) {
  const Vec3& p = state_.sites[p_].position;
  link_.clear();
  for (int j = 0; j < size(); ++j) link_.push_back({frame_.offset(j), frame_.constant(j)});
  const double own = state_.distance_at(cell_reach_, p_);
  const Sheet* sheet = distance > widest * own ? sheets_.known(p_) : sheets_.around(p_, p, distance);
  if (sheet && sheet->covers(p, distance) && Sheets::has_one_component(*sheet, own, link_)) return true;
  others_.clear();
  cell_power_ = distance * distance - state_.sites[p_].weight;
  const auto is_lost = [&](const Vec3& center, double radius) {
    return frame_.is_behind(Vec3(0, 0, 0), 0, center - p, radius, Frame::nobody);
  };
  facets_.clear();
  state_.facets.near_but(p, distance, is_lost, facets_);
  return std::ranges::all_of(facets_, [&](FacetId t) {
    return flood_.meets(t) || !state_.clipper.comes_near(t, p, distance) ||
           is_lost(state_.clipper.middle(t), state_.clipper.radius(t)) || owns_nothing_of(t);
  });
}

/// Is some site nearer than p_, everywhere on the facet? Mostly it is one and the same at all three corners.
/// Else the facet is clipped, in doubles, by those who are nearer somewhere, and what is left kept a little
/// too large.
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
  if (others_.empty()) {  // another sheet: who else is there?
    const double radius = state_.distance_at(cell_power_, p_);
    state_.near({p_, state_.sites[p_].position, radius, cell_power_}, others_);
  }
  return std::ranges::any_of(others_, [&](SiteId s) {
    if (s == p_) return false;
    const WeightedPoint3 &site = state_.sites[s], &origin = frame_.origin();
    return keep_part(Frame::offset(site, origin), Frame::constant(site, origin), most);
  });
}

/// Clips part_ to where a site, given by its d and c, is not nearer than p_. True if nothing is left. `size`
/// bounds all |y|; what rounding may have misplaced, by far less than a 2^-40th of it, is kept.
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
  flood_.clear();
  strangers_.forget();
  state_.admit(p, point);
  if (!find_conflict(first)) return false;
  double far2 = 0;
  for (const CircleId c : conflict_)
    far2 = std::max(far2, (state_.circles[c].center - point.position).squaredNorm());
  if (!prove_new_cell(home, std::sqrt(with_tolerance(far2)), conflict_)) return false;
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
  for (const SiteId r : rim_) lower_reach(r);
  change.cells = rim_;
  std::ranges::sort(change.cells);
  return true;
}

/// Of a regular site whose cell became smaller: from the edges around it, if they are on a sheet that goes on
/// beyond them. Counterclockwise around the site they have its cell inside, where nothing is farther
/// (chart.h).
void FastWay::lower_reach(SiteId r) {
  const WeightedPoint3& site = state_.sites[r];
  const Sheet* sheet = sheets_.known(r);
  if (state_.shape(r) != DualState::Shape::regular || !sheet) return;
  double far2 = 0;
  Vec3 twice_area(0, 0, 0);
  for (const CircleId c : state_.circles.of_site(r)) {
    const EmptyCircle& from = state_.circles[c];
    const std::size_t i = from.index_of(r);
    const EmptyCircle& to = state_.circles[from.beyond[from.after(i)]];
    const TracedEdge::Extent extent =
        extent_of_edge(state_.mesh, site, state_.sites[from.sites[from.before(i)]],
                       {from.facet, to.facet, from.center, to.center});
    far2 = std::max(far2, extent.far2);
    twice_area += extent.twice_area;
  }
  far2 = with_tolerance(far2);
  if (!(far2 - site.weight < state_.reach[r]) || !sheet->covers(site.position, std::sqrt(far2)) ||
      !(twice_area.dot(sheet->axis) > 1e-6 * far2))
    return;
  state_.set_reach(r, far2 - site.weight);
}

/// The circles that p_ beats, from one of them on, and the cycle of edges around them: rim_, outer_, starts_.
bool FastWay::find_conflict(CircleId first) {
  struct Edge {
    SiteId a, b;
    CircleId outer, inner;
  };
  std::array<Edge, 3 * most> edges;
  std::size_t num_edges = 0;
  const WeightedPoint3& point = state_.sites[p_];
  conflict_.assign(1, first);
  if (!state_.lead_at(state_.circles[first], point).negative()) return false;
  for (std::size_t n = 0; n < conflict_.size(); ++n) {
    const EmptyCircle circle = state_.circles[conflict_[n]];
    for (std::size_t i = 0; i < 3; ++i) {
      const CircleId other = circle.beyond[i];
      if (!other.valid()) return false;
      if (std::ranges::find(conflict_, other) != conflict_.end()) continue;
      const Sure found = state_.lead_at(state_.circles[other], point);
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
  flood_.clear();
  strangers_.forget();
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
  cell_reach_ = power_bound_at_corners();
  if (!no_stranger_in_cell(ampler * state_.distance_at(cell_reach_, p))) return false;
  on_sheet_ =
      known <= widest * state_.distance_at(cell_reach_, p) && chart_around(known) && enclose_on_sheet(known);
  if (!on_sheet_ && (!trace_cell(state_.home[p]) || !has_one_component(known))) return false;
  state_.set_reach(p, std::min(state_.reach[p], cell_reach_));
  return true;
}

}  // namespace geom
