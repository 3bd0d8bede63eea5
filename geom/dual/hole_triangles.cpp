#include "geom/dual/hole_triangles.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

/// Not far from all circles: where p is, if that is known.
FacetId HoleTriangles::start() const {
  const FacetId home = around_.state.home[around_.p];
  return home.valid() ? home : around_.state.circles[around_.rim.inner(0)].facet;
}

bool HoleTriangles::fill() {
  if (recall() && find_circles()) return true;
  return guess() && find_circles();
}

bool HoleTriangles::find_circles() {
  FacetId near = start();
  for (Triangle& triangle : all()) {
    if (!find_circle(triangle, near)) return false;
    near = triangle.facet();
  }
  if (!flip_until_empty()) return false;
  if (around_.leeway && (are_flipped_ || around_.leeway->num_guesses == 0)) remember();
  return true;
}

/// Those of the last time, if p has had leeway since.
bool HoleTriangles::recall() {
  if (!around_.leeway || around_.leeway->num_guesses == 0) return false;
  size_ = 0;
  for (const auto& [corners, beyond] : around_.leeway->last_triangles()) {
    Triangle& triangle = triangles_[size_++];
    for (std::size_t e = 0; e < 3; ++e) triangle.corners[e] = corners[e], triangle.beyond[e] = beyond[e];
  }
  return true;
}

void HoleTriangles::remember() const {
  std::array<Leeway::Guess, Rim::most> guesses;
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t e = 0; e < 3; ++e) {
      guesses[i].corners[e] = static_cast<std::int8_t>(triangles_[i].corners[e]);
      guesses[i].beyond[e] = static_cast<std::int8_t>(triangles_[i].beyond[e]);
    }
  around_.state.leeways.set_guesses(around_.p, {guesses.data(), size_});
}

/// The rim in a plane: that of the chart, or else one along most of it.
bool HoleTriangles::flatten_rim() {
  x_.resize(index(around_.rim.size()));
  y_.resize(index(around_.rim.size()));
  if (around_.leeway) {
    const Vec3 &u = around_.leeway->u, v = around_.leeway->axis.cross(u);
    for (int j = 0; j < around_.rim.size(); ++j)
      x_[index(j)] = around_.frame.offset(j).dot(u), y_[index(j)] = around_.frame.offset(j).dot(v);
    return true;
  }
  if (around_.on_sheet) {
    for (int j = 0; j < around_.rim.size(); ++j)
      x_[index(j)] = around_.chart.x(j), y_[index(j)] = around_.chart.y(j);
    return true;
  }
  Vec3 normal(0, 0, 0);
  for (int j = 0; j < around_.rim.size(); ++j)
    normal += around_.frame.offset(j).cross(around_.frame.offset(around_.rim.next(j)));
  const double length = normal.norm();
  if (!(length > 0)) return false;
  normal /= length;
  const Vec3 reference = std::abs(normal.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = reference.cross(normal).normalized(), v = normal.cross(u);
  for (int j = 0; j < around_.rim.size(); ++j)
    x_[index(j)] = around_.frame.offset(j).dot(u), y_[index(j)] = around_.frame.offset(j).dot(v);
  return true;
}

// Gift wrapping in the plane of the rim, as in regular2: in the part of the polygon beyond a chord the apex
// is the corner whose circle with the chord's ends holds no other.
bool HoleTriangles::guess() {
  if (!flatten_rim()) return false;
  struct Chord {
    int first, last, beyond, side;  ///< of the triangle beyond, where this one will be beyond
  };
  std::array<Chord, Rim::most> waiting;
  std::size_t num_waiting = 0;
  size_ = 0;
  waiting[num_waiting++] = {0, around_.rim.size() - 1, -1 - (around_.rim.size() - 1), 0};
  while (num_waiting > 0) {
    const auto [first, last, beyond, side] = waiting[--num_waiting];
    const int a = apex(first, last), i = static_cast<int>(size_);
    if (a < 0) return false;
    Triangle& triangle = triangles_[size_++];
    triangle.corners = {first, a, last};
    triangle.beyond = {-1 - a, beyond, -1 - first};
    if (beyond >= 0) numbered(beyond).beyond[index(side)] = i;
    if (a - first > 1) waiting[num_waiting++] = {first, a, i, 2};
    if (last - a > 1) waiting[num_waiting++] = {a, last, i, 0};
  }
  return true;
}

int HoleTriangles::apex(int first, int last) const {
  if (last - first == 2) return first + 1;
  const double ax = x_[index(last)], ay = y_[index(last)], al = around_.frame.constant(last);
  const double bx = x_[index(first)] - ax, by = y_[index(first)] - ay;
  const double b2 = bx * bx + by * by, bl = around_.frame.constant(first) - al - 2 * (ax * bx + ay * by);
  int best = -1;
  double best_height = 0, best_det = 0;
  for (int k = first + 1; k < last; ++k) {
    const double cx = x_[index(k)] - ax, cy = y_[index(k)] - ay, det = bx * cy - by * cx;
    if (!(det > 0)) continue;
    const double height =
        (around_.frame.constant(k) - al - 2 * (ax * cx + ay * cy)) * b2 - bl * (bx * cx + by * cy);
    if (best >= 0 && !(best_height * det - height * best_det > 0)) continue;
    best = k;
    best_height = height;
    best_det = det;
  }
  return best;
}

bool HoleTriangles::find_circle(Triangle& triangle, FacetId start) {
  const auto& [a, b, c] = triangle.corners;
  triangle.meeting = around_.meeting({around_.rim[a], around_.rim[b], around_.rim[c]}, start);
  if (!triangle.facet().valid()) return false;
  triangle.point = around_.on_surface(triangle.facet(), triangle.meeting.point);
  around_.frame.evaluate(around_.frame.place_of(triangle.point), triangle.point.off, triangle.values);
  return true;
}

/// Is all of the rim certainly farther than a triangle's corners, of each? And p nearer?
bool HoleTriangles::are_empty() const {
  return std::ranges::all_of(all(), [](const Triangle& triangle) {
    const int corner = triangle.corners[0];
    return triangle.values.num_not_farther(corner) <= 3 && triangle.values.nearer(Frame::none, corner);
  });
}

/// The surface has the last word: flips edges until no circle holds the corner across.
bool HoleTriangles::flip_until_empty() {
  are_flipped_ = false;
  if (are_empty()) return true;
  const auto holds = [&](const Triangle& triangle, int site, bool& certain) {
    const Sure lead = triangle.values.difference(site, triangle.corners[0]);
    certain &= lead.certain();
    return lead.value < 0;
  };
  bool certain = true;
  const auto find_flip = [&] {
    for (int i = 0; i < static_cast<int>(size_); ++i)
      for (int e = 0; e < 3; ++e) {
        const int j = numbered(i).beyond[index(e)];
        if (j < i) continue;
        int f = 0;
        while (numbered(j).beyond[index(f)] != i) ++f;
        if (!holds(numbered(i), numbered(j).corners[index(f)], certain) &&
            !holds(numbered(j), numbered(i).corners[index(e)], certain))
          continue;
        are_flipped_ = true;
        const FacetId start = numbered(i).facet();
        flip(i, e, j, f);
        certain &= find_circle(numbered(i), start) && find_circle(numbered(j), start);
        return true;
      }
    return false;
  };
  for (int flips = 0; find_flip(); ++flips)
    if (!certain || flips > 4 * around_.rim.size()) return false;
  return certain && are_empty();
}

//      p            p           Edge (q, r) of triangles i = (p, q, r) and j = (o, r, q) becomes (p, o): i =
//     /i\          /|\          (p, q, o) and j = (p, o, r).
//    q---r   ->   q | r
//     \j/          \|/
//      o            o
void HoleTriangles::flip(int i, int e, int j, int f) {
  const auto after = [](int k) { return k == 2 ? 0 : k + 1; };
  const auto before = [](int k) { return k == 0 ? 2 : k - 1; };
  const Triangle a = numbered(i), b = numbered(j);
  const int p = a.corners[index(e)], q = a.corners[index(after(e))], r = a.corners[index(before(e))],
            o = b.corners[index(f)];
  const int pq = a.beyond[index(before(e))], rp = a.beyond[index(after(e))], qo = b.beyond[index(after(f))],
            o_r = b.beyond[index(before(f))];
  numbered(i).corners = {p, q, o};
  numbered(i).beyond = {qo, j, pq};
  numbered(j).corners = {p, o, r};
  numbered(j).beyond = {o_r, rp, i};
  if (qo >= 0) std::ranges::replace(numbered(qo).beyond, j, i);
  if (rp >= 0) std::ranges::replace(numbered(rp).beyond, i, j);
}

}  // namespace geom
