#include "geom/dual/fast_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double more = 1 + 1e-9;       // for the rounding of distances
constexpr std::size_t walk_limit = 256;  // facets

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

FastWay::FastWay(DualState& state)
    : state_(state), frame_(state.mesh), flood_(state.mesh, frame_), sheets_(state.mesh, state.facets) {}

// --- removal -------------------------------------------------------------------------------------

bool FastWay::plan(SiteId p) {
  known_radius_ = -1;
  if (state_.types == CornerTypes::all || !state_.is_regular(p) || !open_star(p)) return false;
  frame_.begin(state_.sites[p]);
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  if (!guess_triangles()) return false;
  for (Triangle& triangle : triangles_) {
    const int parent = triangle.beyond[1];
    const FacetId start = parent >= 0 ? triangles_[at(parent)].facet : state_.circles[star_[at(triangle.corners[1])]].facet;
    if (!find_circle(triangle, start)) return false;
  }
  if (!flip_until_empty() || !prove_hole()) return false;
  circles_.clear();
  for (const Triangle& triangle : triangles_) {
    const auto& [a, b, c] = triangle.corners;
    circles_.push_back(circle_of({rim_[at(a)], rim_[at(b)], rim_[at(c)]}, triangle.facet, triangle.point));
    max_radius2_ = std::max(max_radius2_, circles_.back().radius2);
  }
  return true;
}

/// The circles of p in cyclic order, if they are one cycle.
bool FastWay::open_star(SiteId p) {
  p_ = p;
  const std::span<const CircleId> own = state_.circles.of_site(p);
  if (own.size() < 3 || own.size() > most) return false;
  rim_.clear();
  star_.clear();
  outer_.clear();
  CircleId c = own.front();
  for (std::size_t j = 0; j < own.size(); ++j) {
    const EmptyCircle& circle = state_.circles[c];
    const std::size_t i = circle.index_of(p);
    const SiteId first = circle.sites[circle.after(i)];
    if (j > 0 && first != state_.circles[star_.back()].sites[state_.circles[star_.back()].before(
                              state_.circles[star_.back()].index_of(p))])
      return false;
    if (std::ranges::find(rim_, first) != rim_.end() || !circle.beyond[i].valid()) return false;
    rim_.push_back(first);
    star_.push_back(c);
    outer_.push_back(circle.beyond[i]);
    c = circle.beyond[circle.after(i)];
    if (!c.valid() || (c == own.front()) != (j + 1 == own.size())) return false;
  }
  return true;
}

// Gift wrapping in the plane of the rim, as in regular2: in the part of the polygon beyond a chord the apex is the corner
// whose circle with the chord's ends holds no other.
bool FastWay::guess_triangles() {
  Vec3 normal(0, 0, 0);
  for (int j = 0; j < size(); ++j) normal += frame_.offset(j).cross(frame_.offset(next(j)));
  const double length = normal.norm();
  if (!(length > 0)) return false;
  normal /= length;
  const Vec3 reference = std::abs(normal.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = reference.cross(normal).normalized(), v = normal.cross(u);
  x_.resize(rim_.size());
  y_.resize(rim_.size());
  for (int j = 0; j < size(); ++j) {
    x_[at(j)] = frame_.offset(j).dot(u);
    y_[at(j)] = frame_.offset(j).dot(v);
  }
  struct Chord {
    int first, last, beyond, side;  ///< of the triangle beyond, where this one will be beyond
  };
  std::array<Chord, most> waiting;
  std::size_t num_waiting = 0;
  triangles_.clear();
  waiting[num_waiting++] = {0, size() - 1, -1 - (size() - 1), 0};
  while (num_waiting > 0) {
    const auto [first, last, beyond, side] = waiting[--num_waiting];
    const int a = apex(first, last), i = static_cast<int>(triangles_.size());
    if (a < 0) return false;
    Triangle& triangle = triangles_.emplace_back();
    triangle.corners = {first, a, last};
    triangle.beyond = {-1 - a, beyond, -1 - first};
    if (beyond >= 0) triangles_[at(beyond)].beyond[at(side)] = i;
    if (a - first > 1) waiting[num_waiting++] = {first, a, i, 2};
    if (last - a > 1) waiting[num_waiting++] = {a, last, i, 0};
  }
  return true;
}

int FastWay::apex(int first, int last) const {
  if (last - first == 2) return first + 1;
  const double ax = x_[at(last)], ay = y_[at(last)], al = frame_.constant(last);
  const double bx = x_[at(first)] - ax, by = y_[at(first)] - ay;
  const double b2 = bx * bx + by * by, bl = frame_.constant(first) - al - 2 * (ax * bx + ay * by);
  int best = -1;
  double best_height = 0, best_det = 0;
  for (int k = first + 1; k < last; ++k) {
    const double cx = x_[at(k)] - ax, cy = y_[at(k)] - ay, det = bx * cy - by * cx;
    if (!(det > 0)) continue;
    const double height = (frame_.constant(k) - al - 2 * (ax * cx + ay * cy)) * b2 - bl * (bx * cx + by * cy);
    if (best >= 0 && !(best_height * det - height * best_det > 0)) continue;
    best = k;
    best_height = height;
    best_det = det;
  }
  return best;
}

/// Where the axis of three sites (none: the origin) meets the surface, counterclockwise there: from facet to facet across
/// the edge that is farthest beyond.
FacetId FastWay::walk(int a, int b, int c, FacetId start) {
  FacetId t = start;
  for (std::size_t step = 0; step < walk_limit; ++step) {
    const TriMesh::Facet& corners = state_.mesh.facet(t);
    const Frame::Slot s0 = frame_.at(corners[0]), s1 = frame_.at(corners[1]), s2 = frame_.at(corners[2]);
    int least = 0;
    const Frame::Meets meets =
        Frame::axis_meets({&frame_.vertex(s0), &frame_.vertex(s1), &frame_.vertex(s2)}, {a, b, c}, least);
    if (meets == Frame::Meets::inside) return t;
    if (meets == Frame::Meets::unsure) return FacetId();
    t = state_.mesh.across(t, least == 2 ? 0 : least + 1);
    if (!t.valid()) return FacetId();
  }
  return FacetId();
}

bool FastWay::find_circle(Triangle& triangle, FacetId start) {
  const auto& [a, b, c] = triangle.corners;
  triangle.facet = walk(a, b, c, start);
  if (!triangle.facet.valid()) return false;
  std::array<SiteId, 3> sites{rim_[at(a)], rim_[at(b)], rim_[at(c)]};
  std::ranges::sort(sites);
  triangle.point = state_.clipper.meeting(triangle.facet, sites);
  frame_.evaluate(triangle.point.position - frame_.origin().position, triangle.point.tolerance, triangle.values);
  return true;
}

/// The surface has the last word: flips edges until no circle holds the corner across, then looks at the whole rim.
bool FastWay::flip_until_empty() {
  const auto holds = [&](const Triangle& triangle, int site, bool& certain) {
    const Sure lead = triangle.values.difference(site, triangle.corners[0]);
    certain &= lead.certain();
    return lead.value < 0;
  };
  bool certain = true;
  const auto find_flip = [&] {
    for (int i = 0; i < static_cast<int>(triangles_.size()); ++i)
      for (int e = 0; e < 3; ++e) {
        const int j = triangles_[at(i)].beyond[at(e)];
        if (j < i) continue;
        int f = 0;
        while (triangles_[at(j)].beyond[at(f)] != i) ++f;
        if (!holds(triangles_[at(i)], triangles_[at(j)].corners[at(f)], certain) &&
            !holds(triangles_[at(j)], triangles_[at(i)].corners[at(e)], certain))
          continue;
        const FacetId start = triangles_[at(i)].facet;
        flip(i, e, j, f);
        certain &= find_circle(triangles_[at(i)], start) && find_circle(triangles_[at(j)], start);
        return true;
      }
    return false;
  };
  for (int flips = 0; find_flip(); ++flips)
    if (!certain || flips > 4 * size()) return false;
  for (const Triangle& triangle : triangles_) {
    for (int s = 0; s < size(); ++s)
      if (std::ranges::find(triangle.corners, s) == triangle.corners.end() && holds(triangle, s, certain)) return false;
    if (!holds(triangle, Frame::none, certain)) return false;  // in the cell of p
  }
  return certain;
}

//      p            p           Edge (q, r) of triangles i = (p, q, r) and j = (o, r, q) becomes (p, o): i = (p, q, o) and
//     /i\          /|\          j = (p, o, r).
//    q---r   ->   q | r
//     \j/          \|/
//      o            o
void FastWay::flip(int i, int e, int j, int f) {
  const auto after = [](int k) { return k == 2 ? 0 : k + 1; };
  const auto before = [](int k) { return k == 0 ? 2 : k - 1; };
  const Triangle a = triangles_[at(i)], b = triangles_[at(j)];
  const int p = a.corners[at(e)], q = a.corners[at(after(e))], r = a.corners[at(before(e))], o = b.corners[at(f)];
  const int pq = a.beyond[at(before(e))], rp = a.beyond[at(after(e))], qo = b.beyond[at(after(f))],
            o_r = b.beyond[at(before(f))];
  triangles_[at(i)].corners = {p, q, o};
  triangles_[at(i)].beyond = {qo, j, pq};
  triangles_[at(j)].corners = {p, o, r};
  triangles_[at(j)].beyond = {o_r, rp, i};
  if (qo >= 0) std::ranges::replace(triangles_[at(qo)].beyond, j, i);
  if (rp >= 0) std::ranges::replace(triangles_[at(rp)].beyond, i, j);
}

/// Sets reach_ and max_radius2_ but for the circles.
bool FastWay::prove_hole() {
  facets_.clear();
  for (const CircleId c : star_) facets_.push_back(state_.circles[c].facet);
  if (!flood_.trace(facets_, true)) return false;
  for (const Triangle& triangle : triangles_) {
    const auto& [a, b, c] = triangle.corners;
    if (!flood_.add_end(triangle.facet, a, b) || !flood_.add_end(triangle.facet, b, c) ||
        !flood_.add_end(triangle.facet, c, a))
      return false;
  }
  for (int j = 0; j < size(); ++j)
    if (!flood_.add_end(facets_[at(j)], j, next(j))) return false;
  if (!flood_.is_complete()) return false;
  const WeightedPoint3& site = state_.sites[p_];
  double radius2 = flood_.radius2();
  for (const CircleId c : star_)
    radius2 = std::max(radius2, (state_.circles[c].center - site.position).squaredNorm());
  reach_ = radius2 * more - site.weight;
  max_radius2_ = reach_;
  for (const Flood::Corner& corner : flood_.corners()) {
    const double weight = state_.sites[rim_[at(corner.site)]].weight;
    const double far = std::sqrt(std::max(0.0, frame_.power(corner.y, corner.site) + weight)) + corner.tolerance;
    max_radius2_ = std::max(max_radius2_, far * far * more - weight);
  }
  double most_power = max_radius2_;
  points_.clear();
  nearest_.clear();
  for (const Triangle& triangle : triangles_) {
    points_.push_back(triangle.point);
    nearest_.push_back(triangle.corners[0]);
    const Vec3 y = triangle.point.position - site.position;
    most_power = std::max(most_power, frame_.power(y, triangle.corners[0]));
  }
  const Vacancy hole{p_, site.position, std::sqrt(radius2 * more), most_power + 1e-9 * std::abs(most_power)};
  candidates_.clear();
  if (!state_.paper) {
    look_around(hole);
    return is_empty_of_strangers(hole, points_, nearest_);
  }
  state_.paper->remove(p_);
  state_.paper->heirs(hole, candidates_);
  if (is_empty_of_strangers(hole, points_, nearest_)) return true;
  cancel();
  return false;
}

void FastWay::cancel() {
  if (state_.paper) state_.paper->insert(p_, state_.sites[p_], rim_.front());
}

/// Candidates for a vacancy. If they are few cells of the grid away, at once all sites that may lose something to p_ near
/// there, or own something of a cell there: for its insertion.
void FastWay::look_around(const Vacancy& vacancy) {
  const double distance = std::max(vacancy.radius + state_.distance_at(vacancy.max_radius2),
                                   2.1 * state_.distance_at(state_.largest_reach()));
  known_radius_ = -1;
  if (state_.find_near(vacancy.center, distance, candidates_)) {
    known_center_ = vacancy.center;
    known_radius_ = distance;
  } else {
    state_.near(vacancy, candidates_);
  }
}

/// Are all sites within that distance of x among the candidates that were found last?
bool FastWay::knows(const Vec3& x, double distance) const {
  return ((x - known_center_).norm() + distance) * more < known_radius_;
}

/// A bound of the reach of those who may lose something to p_.
double FastWay::power_of_rivals() {
  const WeightedPoint3& point = state_.sites[p_];
  const double largest = state_.largest_reach();
  const double enough = 1.45 * (cell_reach_ + point.weight) - point.weight;
  if (largest <= enough) return largest;
  if (!knows(point.position, 2 * state_.distance_at(largest))) return state_.tree.largest_rival_reach(point, enough);
  double power = -infinity;
  for (const SiteId s : candidates_)
    if (s != p_) power = std::max(power, state_.reach[s]);
  return power;
}

/// Is no candidate but the rim's nearer than the sites that are said to be nearest, at all corners of the flood and at
/// these circles? Most are nowhere in the ball nearer than some site of the rim, or than the origin.
bool FastWay::is_empty_of_strangers(const Vacancy& cell, std::span<const RoundedPoint> circles,
                                    std::span<const int> nearest_of_circles) {
  const bool is_hole = !nearest_of_circles.empty();
  const double limit2 = 4 * cell.radius * cell.radius * (1 + 1e-6);
  return std::ranges::all_of(candidates_, [&](SiteId s) {
    if (s == p_ || std::ranges::find(rim_, s) != rim_.end()) return true;
    const Vec3 d = Frame::offset(state_.sites[s], frame_.origin());
    const double c = Frame::constant(state_.sites[s], frame_.origin()), d2 = d.squaredNorm();
    const auto is_behind = [&](const Vec3& from, double constant) {
      const double lead = c - constant;
      return lead > 1e-9 * d2 && lead * lead > limit2 * (d - from).squaredNorm();
    };
    if (!is_hole && is_behind(Vec3(0, 0, 0), 0)) return true;
    for (int j = 0; is_hole && j < size(); ++j)
      if (is_behind(frame_.offset(j), frame_.constant(j))) return true;
    Frame::Values values;
    const auto is_farther = [&](const Vec3& y, double off, int nearest) {
      frame_.evaluate(y, off, values);
      return frame_.difference(values, d, c, nearest).positive();
    };
    for (const Flood::Corner& corner : flood_.corners())
      if (!is_farther(corner.y, corner.tolerance, corner.site)) return false;
    for (std::size_t i = 0; i < circles.size(); ++i)
      if (!is_farther(circles[i].position - frame_.origin().position, circles[i].tolerance,
                      is_hole ? nearest_of_circles[i] : Frame::none))
        return false;
    return true;
  });
}

EmptyCircle FastWay::circle_of(const std::array<SiteId, 3>& counterclockwise, FacetId facet,
                               const RoundedPoint& point) const {
  EmptyCircle circle;
  circle.facet = facet;
  circle.sites = counterclockwise;
  circle.sort_counterclockwise();
  state_.center_circle(circle, point.position);
  return circle;
}

void FastWay::remove(DualChange& change) {
  for (const CircleId c : star_) {
    state_.circles.erase(c);
    change.circles_erased.push_back(c);
  }
  const std::size_t first = change.circles_created.size();
  for (const EmptyCircle& circle : circles_) change.circles_created.push_back(state_.circles.create(circle));
  const auto id = [&](int i) { return change.circles_created[first + at(i)]; };
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i)
    for (int e = 0; e < 3; ++e) {
      const int beyond = triangles_[at(i)].beyond[at(e)];
      const CircleId other = beyond >= 0 ? id(beyond) : outer_[at(-1 - beyond)];
      state_.circles.set_beyond(id(i), state_.circles[id(i)].index_of(rim_[at(triangles_[at(i)].corners[at(e)])]), other);
      if (beyond >= 0) continue;
      const int j = -1 - beyond;
      state_.circles.set_beyond(other, state_.circles[other].opposite(rim_[at(j)], rim_[at(next(j))]), id(i));
    }
  for (const SiteId r : rim_) state_.raise_reach(r, max_radius2_);
  state_.leave(p_);
  state_.reach[p_] = -infinity;
  change.cells = rim_;
  std::ranges::sort(change.cells);
}

// --- insertion -----------------------------------------------------------------------------------

bool FastWay::move_in_place(std::size_t circle, const WeightedPoint3& point, DualChange& change) {
  const WeightedPoint3 old = state_.sites[p_];
  const Vec3 d = Frame::offset(point, old);
  const double c = Frame::constant(point, old);
  for (const Triangle& triangle : triangles_)
    if (!frame_.difference(triangle.values, d, c, triangle.corners[0]).negative()) return false;
  const double tolerance = 2 * state_.clipper.most_tolerance();
  Frame::Values values;
  for (int j = 0; j < size(); ++j) {
    frame_.evaluate(state_.circles[outer_[at(j)]].center - old.position, tolerance, values);
    if (!frame_.difference(values, d, c, j).positive()) return false;
  }

  const double least_distance = (state_.distance_at(reach_, p_) + d.norm()) * more;  // H is in this ball
  hole_corners_.clear();
  for (const Flood::Corner& corner : flood_.corners())
    hole_corners_.push_back({corner.y + old.position, frame_.power(corner.y, corner.site), corner.tolerance});
  state_.sites[p_] = point;
  starts_.clear();
  for (const CircleId s : star_) starts_.push_back(state_.circles[s].facet);
  const FacetId home = triangles_[circle].facet;
  if (!prove_new_cell(home, least_distance, star_)) {
    state_.sites[p_] = old;
    return false;
  }
  state_.follow(p_, old.position);
  state_.home[p_] = home;
  for (int j = 0; j < size(); ++j) {
    EmptyCircle moved = state_.circles[star_[at(j)]];
    moved.facet = corners_[at(j)].facet;
    state_.center_circle(moved, corners_[at(j)].point.position);
    state_.circles.move(star_[at(j)], moved.center, moved.radius2, moved.facet);
    change.circles_moved.push_back(star_[at(j)]);
  }
  state_.set_reach(p_, cell_reach_);
  // What the rim has now of the hole lies between the old border, the new one, and corners that p does not take.
  double power = std::max(reach_, cell_reach_);
  for (const auto& [z, without_p, off] : hole_corners_)
    if (geom::power(z, point) > without_p) {
      const double weight = -old.weight;  // any will do: the power is turned into a distance and back
      const double far = std::sqrt(std::max(0.0, without_p - weight)) + off;
      power = std::max(power, far * far * more + weight);
    }
  for (const SiteId r : rim_) state_.raise_reach(r, power);
  change.cells = rim_;
  std::ranges::sort(change.cells);
  return true;
}

/// p_ is at its new place, but not in the tree; the rim and the facets to start from are known.
bool FastWay::prove_new_cell(FacetId home, double least_distance, std::span<const CircleId> reached) {
  if (!find_star_corners()) return false;
  if (state_.paper) state_.paper->insert(p_, state_.sites[p_], rim_.front());
  const auto prove = [&] {
    if (!trace_cell(home) || may_beat_unreached(reached)) return false;
    return has_one_component(std::max(least_distance, state_.distance_at(power_of_rivals(), p_)));
  };
  if (prove()) return true;
  if (state_.paper) state_.paper->remove(p_);
  return false;
}

/// Of the new cell of p_, empty but for strangers.
bool FastWay::find_star_corners() {
  frame_.begin(state_.sites[p_]);
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  corners_.clear();
  Frame::Values values;
  for (int j = 0; j < size(); ++j) {
    const FacetId t = walk(Frame::none, j, next(j), starts_[at(j)]);
    if (!t.valid()) return false;
    std::array<SiteId, 3> sites{p_, rim_[at(j)], rim_[at(next(j))]};
    std::ranges::sort(sites);
    const RoundedPoint point = state_.clipper.meeting(t, sites);
    frame_.evaluate(point.position - frame_.origin().position, point.tolerance, values);
    for (int i = 0; i < size(); ++i)
      if (i != j && i != next(j) && !values.nearer(Frame::none, i)) return false;
    corners_.push_back({t, point});
  }
  return true;
}

/// Sets cell_reach_. `home`: a facet with the location of p_.
bool FastWay::trace_cell(FacetId home) {
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
  const Vacancy cell{p_, site.position, std::sqrt(radius2 * more), cell_reach_};
  if (state_.paper) {
    candidates_.clear();
    state_.paper->rivals(p_, candidates_);
  } else if (!knows(site.position, cell.radius + state_.distance_at(cell_reach_))) {
    candidates_.clear();
    look_around(cell);
  }
  return is_empty_of_strangers({p_, site.position, std::sqrt(radius2 * more), cell_reach_}, points_, {});
}

/// May p_ beat circles that are not reached? They would be of an irregular site.
bool FastWay::may_beat_unreached(std::span<const CircleId> reached) {
  if (state_.num_irregular == 0) return false;
  rivals_.clear();
  state_.tree.rivals(state_.sites[p_], rivals_);
  return std::ranges::any_of(rivals_, [&](SiteId s) {
    if (s == p_ || state_.is_regular(s)) return false;
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
  if (sheets_.has_one_component(p, distance, link_)) return true;
  candidates_.clear();
  known_radius_ = -1;
  cell_power_ = distance * distance - state_.sites[p_].weight;
  return std::ranges::all_of(sheets_.facets_within(p, distance), [&](FacetId t) {
    return flood_.meets(t) || !state_.clipper.comes_near(t, p, distance) || owns_nothing_of(t);
  });
}

/// Mostly one and the same site of the rim is nearer at all three corners.
bool FastWay::owns_nothing_of(FacetId t) {
  const TriMesh::Facet& corners = state_.mesh.facet(t);
  const Frame::Slot s0 = frame_.at(corners[0]), s1 = frame_.at(corners[1]), s2 = frame_.at(corners[2]);
  const Frame::Vertex &v0 = frame_.vertex(s0), &v1 = frame_.vertex(s1), &v2 = frame_.vertex(s2);
  if (v0.sure && v1.sure && v2.sure && (v0.beaten_by & v1.beaten_by & v2.beaten_by) != 0) return true;
  state_.clipper.start(polygon_, t, p_);
  const auto takes_all = [&](SiteId s) { return s != p_ && state_.clipper.clip(polygon_, s) == Clip::swallowed; };
  if (std::ranges::any_of(rim_, takes_all)) return true;
  if (candidates_.empty()) {  // another sheet: who else is there?
    const double radius = state_.distance_at(cell_power_, p_);
    state_.near({p_, state_.sites[p_].position, radius, cell_power_}, candidates_);
  }
  return std::ranges::any_of(candidates_, takes_all);
}

bool FastWay::insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId first, DualChange& change) {
  if (state_.types == CornerTypes::all) return false;
  p_ = p;
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
  state_.set_regular(p, true);
  for (const CircleId c : conflict_)
    for (const SiteId s : state_.circles[c].sites)  // who has lost all is hidden now
      if (s != p && state_.circles.of_site(s).empty() && state_.reach[s] > -infinity) state_.set_reach(s, -infinity);
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
        edges[num_edges++] = {circle.sites[circle.after(i)], circle.sites[circle.before(i)], other, conflict_[n]};
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
    edge = static_cast<std::size_t>(std::find_if(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(num_edges),
                                                 [&](const Edge& e) { return e.a == b; }) -
                                    edges.begin());
    if (edge == num_edges) return false;
  }
  return edge == 0;
}

// --- regular sites -------------------------------------------------------------------------------

bool FastWay::certify(SiteId p) {
  known_radius_ = -1;
  if (state_.types == CornerTypes::all || !state_.home[p].valid() || !open_star(p)) return false;
  frame_.begin(state_.sites[p]);
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  corners_.clear();
  for (const CircleId c : star_)
    corners_.push_back(
        {state_.circles[c].facet, {state_.circles[c].center, 2 * state_.clipper.most_tolerance()}});
  if (!trace_cell(state_.home[p])) return false;
  const double known = state_.distance_at(state_.reach[p], p);
  if (!has_one_component(known)) return false;
  state_.set_reach(p, std::min(state_.reach[p], cell_reach_));
  return true;
}

}  // namespace geom
