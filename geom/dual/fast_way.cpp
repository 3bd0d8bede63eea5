#include "geom/dual/fast_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double more = 1 + 1e-9;        // for the rounding of distances
constexpr std::size_t walk_limit = 256;  // facets
constexpr double bend = 1.1;             // of an edge does not matter

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

FastWay::FastWay(DualState& state)
    : state_(state),
      frame_(state.mesh),
      flood_(state.mesh, frame_),
      sheets_(state.mesh, state.facets),
      losses_(state, sheets_),
      strangers_(state) {}

// --- removal -------------------------------------------------------------------------------------

bool FastWay::plan(SiteId p) {
  strangers_.forget();
  if (state_.types == CornerTypes::all) return false;
  if (state_.shape(p) == DualState::Shape::unknown) certify(p);
  if (state_.shape(p) != DualState::Shape::regular || !open_star(p)) return false;
  frame_.begin(state_.sites[p]);
  self_ = Frame::none;
  for (const SiteId r : rim_) frame_.add(state_.sites[r]);
  on_sheet_ = chart_star();
  if (!guess_triangles()) return false;
  for (Triangle& triangle : triangles_) {
    const int parent = triangle.beyond[1];
    const FacetId start =
        parent >= 0 ? triangles_[at(parent)].facet : state_.circles[star_[at(triangle.corners[1])]].facet;
    if (!find_circle(triangle, start)) return false;
  }
  if (!flip_until_empty() || !prove_hole()) return false;
  hole_on_sheet_ = on_sheet_;
  circles_.clear();
  for (const Triangle& triangle : triangles_) {
    const auto& [a, b, c] = triangle.corners;
    circles_.push_back(circle_of({rim_[at(a)], rim_[at(b)], rim_[at(c)]}, triangle.facet, triangle.point));
    max_radius2_ = std::max(max_radius2_, circles_.back().radius2);
  }
  return true;
}

bool FastWay::make_plan_exact() {
  if (!hole_on_sheet_) return true;  // it was traced
  const double bound = max_radius2_;
  const bool is_certain = trace_hole();
  flood_.clear();
  if (!is_certain) return max_radius2_ = bound, false;
  for (const EmptyCircle& circle : circles_) max_radius2_ = std::max(max_radius2_, circle.radius2);
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
    if (j > 0 &&
        first != state_.circles[star_.back()]
                     .sites[state_.circles[star_.back()].before(state_.circles[star_.back()].index_of(p))])
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

/// The rim in a plane: that of the chart, or else one along most of it.
bool FastWay::flatten_rim() {
  x_.resize(rim_.size());
  y_.resize(rim_.size());
  if (on_sheet_) {
    for (int j = 0; j < size(); ++j) x_[at(j)] = chart_.x(j), y_[at(j)] = chart_.y(j);
    return true;
  }
  Vec3 normal(0, 0, 0);
  for (int j = 0; j < size(); ++j) normal += frame_.offset(j).cross(frame_.offset(next(j)));
  const double length = normal.norm();
  if (!(length > 0)) return false;
  normal /= length;
  const Vec3 reference = std::abs(normal.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = reference.cross(normal).normalized(), v = normal.cross(u);
  for (int j = 0; j < size(); ++j) x_[at(j)] = frame_.offset(j).dot(u), y_[at(j)] = frame_.offset(j).dot(v);
  return true;
}

// Gift wrapping in the plane of the rim, as in regular2: in the part of the polygon beyond a chord the apex
// is the corner whose circle with the chord's ends holds no other.
bool FastWay::guess_triangles() {
  if (!flatten_rim()) return false;
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

/// Where the axis of three sites (none: the origin) meets the surface, counterclockwise there: from facet to
/// facet across the edge that is farthest beyond.
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
  frame_.evaluate(triangle.point.position - frame_.origin().position, triangle.point.tolerance,
                  triangle.values);
  return true;
}

/// The surface has the last word: flips edges until no circle holds the corner across, then looks at the
/// whole rim.
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
      if (std::ranges::find(triangle.corners, s) == triangle.corners.end() && holds(triangle, s, certain))
        return false;
    if (!holds(triangle, Frame::none, certain)) return false;  // in the cell of p
  }
  return certain;
}

//      p            p           Edge (q, r) of triangles i = (p, q, r) and j = (o, r, q) becomes (p, o): i =
//     /i\          /|\          (p, q, o) and j = (p, o, r).
//    q---r   ->   q | r
//     \j/          \|/
//      o            o
void FastWay::flip(int i, int e, int j, int f) {
  const auto after = [](int k) { return k == 2 ? 0 : k + 1; };
  const auto before = [](int k) { return k == 0 ? 2 : k - 1; };
  const Triangle a = triangles_[at(i)], b = triangles_[at(j)];
  const int p = a.corners[at(e)], q = a.corners[at(after(e))], r = a.corners[at(before(e))],
            o = b.corners[at(f)];
  const int pq = a.beyond[at(before(e))], rp = a.beyond[at(after(e))], qo = b.beyond[at(after(f))],
            o_r = b.beyond[at(before(f))];
  triangles_[at(i)].corners = {p, q, o};
  triangles_[at(i)].beyond = {qo, j, pq};
  triangles_[at(j)].corners = {p, o, r};
  triangles_[at(j)].beyond = {o_r, rp, i};
  if (qo >= 0) std::ranges::replace(triangles_[at(qo)].beyond, j, i);
  if (rp >= 0) std::ranges::replace(triangles_[at(rp)].beyond, i, j);
}

// --- proof of the hole ---------------------------------------------------------------------------

/// Puts the rim and p_ into a chart: is the surface a sheet there, and the chart simple?
bool FastWay::chart_star() {
  double range = state_.reach[p_];  // that the new cell will do with, too
  for (const SiteId r : rim_) range = std::max(range, state_.reach[r]);
  const Sheet* sheet = sheets_.around(p_, state_.sites[p_].position, state_.distance_at(range, p_));
  if (!sheet) return false;
  chart_sites(*sheet);
  const double known = state_.distance_at(state_.reach[p_], p_);
  for (int k = 1; k < chart_.size(); ++k)
    if (!chart_.is_simple_with(k, known)) return false;
  return true;
}

void FastWay::chart_sites(const Sheet& sheet) {
  sheet_ = sheet;
  chart_.begin(sheet);
  for (int j = 0; j < size(); ++j) chart_.add(frame_.offset(j), frame_.constant(j));
  chart_.add(frame_.offset(self_), frame_.constant(self_));
}

/// Sets reach_ and max_radius2_ but for the circles.
bool FastWay::prove_hole() {
  if (state_.paper) state_.paper->remove(p_);
  flood_.clear();
  reach_ = state_.reach[p_];
  on_sheet_ = on_sheet_ && bound_hole();
  if (on_sheet_) {
    if (!no_stranger_in_hole()) return cancel(), false;
    if (is_simple_with_strangers(state_.distance_at(reach_, p_))) return true;
    on_sheet_ = false;
  }
  if (trace_hole() && no_stranger_in_hole()) return true;
  cancel();
  return false;
}

/// A bound of the squared distance where circles may be off.
double FastWay::with_tolerance(double distance2) const {
  const double off = 2 * state_.clipper.most_tolerance();
  return distance2 * (1 + 1e-6) + 1.1e6 * off * off;  // (a + b)^2 <= a^2 (1 + e) + b^2 (1 + 1 / e)
}

/// Sets reach_ from the edges of the cell, max_radius2_ and range_ from the rim.
bool FastWay::bound_hole() {
  const WeightedPoint3& site = state_.sites[p_];
  const auto corner = [&](int j) -> Vec3 { return state_.circles[star_[at(j)]].center - site.position; };
  const auto facet = [&](int j) { return state_.circles[star_[at(j)]].facet; };
  double corner2 = 0, own2 = 0;
  for (int j = 0; j < size(); ++j) corner2 = std::max(corner2, corner(j).squaredNorm());
  for (int j = 0; j < size(); ++j) {
    const int i = previous(j);
    const Edge arc{self_, j, facet(i), facet(j), corner(i), corner(j)};
    own2 = std::max(own2, with_tolerance(farthest2(arc, bend * corner2)));
  }
  reach_ = std::min(reach_, own2 - site.weight);
  const double own = state_.distance_at(reach_, p_);
  if (!sheet_.covers(site.position, own)) return false;
  for (const Triangle& triangle : triangles_)
    if (!(triangle.values.y.squaredNorm() <= own * own)) return false;
  const Chart::Gain most = chart_.most_gain(size(), own, site.weight, state_.heaviest());
  max_radius2_ = std::max(reach_, most.power);
  range_ = most.range;
  return range_ < infinity;
}

/// A bound, squared, of how far an edge of the diagram comes from one of its sites: by the chart, if that is
/// enough, else from facet to facet.
double FastWay::farthest2(const Edge& edge, double enough) const {
  const Vec3 d = frame_.offset(edge.left);
  if (edge.from == edge.to) return std::max((edge.start - d).squaredNorm(), (edge.end - d).squaredNorm());
  const int left = edge.left == self_ ? size() : edge.left;
  const double bound = chart_.farthest2(left, edge.right, edge.start - d, edge.end - d);
  if (bound <= enough) return bound;
  const Vec3& origin = frame_.origin().position;
  const SiteId l = edge.left == self_ ? p_ : rim_[at(edge.left)];
  return std::min(bound, extent_of_edge(state_.mesh, state_.sites[l], state_.sites[rim_[at(edge.right)]],
                                        {edge.from, edge.to, edge.start + origin, edge.end + origin})
                             .far2);
}

bool FastWay::trace_hole() {
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
  for (const Triangle& triangle : triangles_)
    max_radius2_ =
        std::max(max_radius2_, power(triangle.point.position, state_.sites[rim_[at(triangle.corners[0])]]));
  for (const Flood::Corner& corner : flood_.corners()) {
    const double weight = state_.sites[rim_[at(corner.site)]].weight;
    const double far =
        std::sqrt(std::max(0.0, frame_.power(corner.y, corner.site) + weight)) + corner.tolerance;
    max_radius2_ = std::max(max_radius2_, far * far * more - weight);
  }
  return true;
}

/// Are the sites beyond the rim farther at all circles, and at the corners of the flood?
bool FastWay::no_stranger_in_hole() {
  const WeightedPoint3& site = state_.sites[p_];
  const double radius = state_.distance_at(reach_, p_);
  const Vacancy hole{p_, site.position, radius, max_radius2_ + 1e-9 * std::abs(max_radius2_)};
  strangers_.find_heirs(hole, on_sheet_ ? range_ : infinity);
  strangers_.keep_near(frame_, p_, rim_, {Vec3(0, 0, 0), radius}, Frame::nobody);
  const auto is_empty = [&](const Vec3& z, int nearest, double off) {
    return strangers_.are_beyond(z, state_.sites[rim_[at(nearest)]], off);
  };
  return std::ranges::all_of(triangles_,
                             [&](const Triangle& t) {
                               return is_empty(t.point.position, t.corners[0], t.point.tolerance);
                             }) &&
         std::ranges::all_of(flood_.corners(), [&](const Flood::Corner& corner) {
           return is_empty(corner.y + site.position, corner.site, corner.tolerance);
         });
}

/// Is the chart with each of the strangers simple? All that is spoken of is that near to the frame's origin.
bool FastWay::is_simple_with_strangers(double radius) {
  return std::ranges::all_of(strangers_.kept(), [&](const Strangers::Stranger& stranger) {
    chart_.add(stranger.d, stranger.c);
    const bool is_simple = chart_.is_simple_with(size() + 1, radius);
    chart_.take_back();
    return is_simple;
  });
}

void FastWay::cancel() {
  if (state_.paper) state_.paper->insert(p_, state_.sites[p_], rim_.front());
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
      state_.circles.set_beyond(
          id(i), state_.circles[id(i)].index_of(rim_[at(triangles_[at(i)].corners[at(e)])]), other);
      if (beyond >= 0) continue;
      const int j = -1 - beyond;
      state_.circles.set_beyond(other, state_.circles[other].opposite(rim_[at(j)], rim_[at(next(j))]), id(i));
    }
  raise_by_hole();
  state_.leave(p_);
  state_.reach[p_] = -infinity;
  change.cells = rim_;
  std::ranges::sort(change.cells);
}

/// What the rim has now of the hole is bounded by the old border, which it reached before, and the new edges.
/// Across the side from a to b of a triangle the edge has b on its left.
void FastWay::raise_by_hole() {
  if (!hole_on_sheet_) {
    for (const SiteId r : rim_) state_.raise_reach(r, max_radius2_);
    return;
  }
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i)
    for (int e = 0; e < 3; ++e) {
      const Triangle& triangle = triangles_[at(i)];
      const int beyond = triangle.beyond[at(e)];
      if (beyond > i) continue;
      const SiteId a = rim_[at(triangle.corners[at(e == 2 ? 0 : e + 1)])],
                   b = rim_[at(triangle.corners[at(e == 0 ? 2 : e - 1)])];
      TracedEdge edge{triangle.facet, FacetId(), triangle.point.position, Vec3(0, 0, 0)};
      if (beyond >= 0) {
        edge.to = triangles_[at(beyond)].facet;
        edge.end = triangles_[at(beyond)].point.position;
      } else {
        const EmptyCircle& corner = state_.circles[star_[at(-1 - beyond)]];
        edge.to = corner.facet;
        edge.end = corner.center;
      }
      const WeightedPoint3& left = state_.sites[b];
      const double far2 = extent_of_edge(state_.mesh, left, state_.sites[a], edge).far2;
      const double power = std::min(with_tolerance(far2) - left.weight, max_radius2_);
      state_.raise_reach(a, power);
      state_.raise_reach(b, power);
    }
}

}  // namespace geom
