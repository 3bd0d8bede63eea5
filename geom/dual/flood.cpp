#include "geom/dual/flood.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr std::int32_t unlinked = std::numeric_limits<std::int32_t>::min();

}  // namespace

void Flood::clear() {
  facets_.clear();
  corners_.clear();
}

bool Flood::trace(std::span<const FacetId> from, bool division) {
  clear();
  links_.clear();
  links_of_ends_.clear();
  ends_.clear();
  radius2_ = 0;
  division_ = division;
  ++trace_;
  for (const FacetId t : from) meet(t);
  for (std::uint32_t slot = 0; slot < facets_.size(); ++slot)
    for (std::size_t e = 0; e < 3; ++e)
      if (!facets_[slot].done[e] && !trace_edge(slot, e)) return false;
  return true;
}

std::uint32_t Flood::meet(FacetId t) {
  const std::uint32_t known = slot_of_[t];
  if (known < facets_.size() && facets_[known].id == t) return known;
  const auto slot = static_cast<std::uint32_t>(facets_.size());
  slot_of_[t] = slot;
  const TriMesh::Facet& corners = mesh_.facet(t);
  Facet& facet = facets_.add();
  facet.id = t;
  for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = frame_.with_signs(corners[i]);
  facet.done = {false, false, false};
  facet.first_end = -1;
  return slot;
}

/// Looks at an edge of a facet that is met. False if something is not certain.
bool Flood::trace_edge(std::uint32_t slot, std::size_t e) {
  const Frame::Slot from = facets_[slot].corners[e], to = facets_[slot].corners[e == 2 ? 0 : e + 1];
  Interval part;
  {
    const Frame::Vertex &u = frame_.vertex(from), &v = frame_.vertex(to);
    if (!u.sure || !v.sure) return false;
    if ((u.beaten_by & v.beaten_by) != 0) return true;  // one and the same site is nearer all along
    const Meets has_part = interval(u, v, part);
    if (has_part != Meets::yes) return has_part == Meets::no;
  }
  const FacetId across = mesh_.across(facets_[slot].id, static_cast<int>(e));
  if (!across.valid()) return false;
  const std::uint32_t other = meet(across);
  const Frame::Vertex &u = frame_.vertex(from), &v = frame_.vertex(to);  // meet() may have moved them
  std::size_t back = 0;
  while (back < 3 &&
         !(facets_[other].corners[back] == to && facets_[other].corners[back == 2 ? 0 : back + 1] == from))
    ++back;
  if (back == 3) return false;  // the other facet runs the other way round
  facets_[other].done[back] = true;
  on_edge_.clear();
  if (part.begin != at_vertex && !add_point(u, v, part.begin, Frame::none)) return false;
  if (part.end != at_vertex && !add_point(u, v, part.end, Frame::none)) return false;
  if (division_ && !divide(u, v, part)) return false;
  if ((u.owned() && !add_vertex(from)) || (v.owned() && !add_vertex(to))) return false;
  for (std::size_t i = 0; i < on_edge_.size(); ++i) {
    add_end(facets_[slot], on_edge_[i].label, on_edge_[i].node);
    add_end(facets_[other], on_edge_[i].label, on_edge_[i].node);
  }
  return true;
}

// Along the edge from u to v, site i is nearer than the origin before t_i = g_i(u) / (g_i(u) - g_i(v)) if it
// is so at u, and after t_i if at v. So the origin has what lies after the last t_i of the former and before
// the first of the latter. t_i < t_j iff M_ij = g_i(u) g_j(v) - g_j(u) g_i(v) > 0 for two of the same kind, <
// 0 for two of different kinds.
Flood::Meets Flood::interval(const Frame::Vertex& u, const Frame::Vertex& v, Interval& out) {
  out = {at_vertex, at_vertex};
  for (std::uint32_t set = u.beaten_by; set != 0; set &= set - 1) {
    const int i = std::countr_zero(set);
    if (out.begin == at_vertex) {
      out.begin = i;
      continue;
    }
    const Sure m = Frame::determinant(u, v, out.begin, i, Frame::none);
    if (!m.certain()) return Meets::unsure;
    if (m.value > 0) out.begin = i;
  }
  for (std::uint32_t set = v.beaten_by; set != 0; set &= set - 1) {
    const int i = std::countr_zero(set);
    if (out.end == at_vertex) {
      out.end = i;
      continue;
    }
    const Sure m = Frame::determinant(u, v, i, out.end, Frame::none);
    if (!m.certain()) return Meets::unsure;
    if (m.value > 0) out.end = i;
  }
  if (out.begin == at_vertex || out.end == at_vertex) return Meets::yes;
  const Sure m = Frame::determinant(u, v, out.begin, out.end, Frame::none);
  if (!m.certain()) return Meets::unsure;
  return m.value < 0 ? Meets::yes : Meets::no;
}

// The owners along the part without the origin: at a vertex the nearest site, where it is as near as site i
// that one. If both ends have one owner, all between has. Else the bisectors of consecutive owners meet the
// edge, and a third site that is nearer there comes between.
bool Flood::divide(const Frame::Vertex& u, const Frame::Vertex& v, const Interval& part) {
  const int first = part.begin == at_vertex ? frame_.nearest(u) : part.begin,
            last = part.end == at_vertex ? frame_.nearest(v) : part.end;
  if (first < 0 || last < 0) return false;
  if (first == last) return true;
  owners_.assign({first, last});
  for (std::size_t k = 0; k + 1 < owners_.size();) {
    const int a = owners_[k], b = owners_[k + 1];
    if (!u.nearer(a, b) || !v.nearer(b, a)) return false;
    int between = -1;  // the nearest there: it owns something
    double most = 0;
    for (int c = 0; c < frame_.size(); ++c) {
      if (c == a || c == b) continue;
      if (u.nearer(a, c) && v.nearer(a, c)) continue;
      const Sure m = Frame::determinant(u, v, a, c, b);  // (g_a - g_b)(u) (g_c - g_b)(v) - ...
      if (!m.certain()) return false;
      if (!(m.value > most)) continue;
      between = c;
      most = m.value;
    }
    if (between >= 0) {
      if (owners_.size() > Frame::most) return false;
      owners_.insert(owners_.begin() + static_cast<std::ptrdiff_t>(k) + 1, between);
    } else {
      ++k;
    }
  }
  for (std::size_t k = 0; k + 1 < owners_.size(); ++k)
    if (!add_point(u, v, owners_[k], owners_[k + 1])) return false;
  return true;
}

/// The point of the edge where sites i and j (none: the origin) are equally near. In parameter t = f(u) /
/// (f(u) - f(v)) it is off by (1.01 E + E') / |f(u) - f(v)| and roundings at most, E and E' the errors of f.
/// Points of the cell's border are ends of the cell's own edges, but not of those of the division.
bool Flood::add_point(const Frame::Vertex& u, const Frame::Vertex& v, int i, int j) {
  const double fu = u.g[i] - u.g[j], fv = v.g[i] - v.g[j];
  const double difference = std::abs(fu - fv), error = 4 * (u.error + v.error);
  if (!(difference > 4 * error)) return false;
  const double t = std::clamp(std::abs(fu) / difference, 0.0, 1.0);
  const Vec3 along = v.y - u.y, y = u.y + t * along;
  const double tolerance = (2 * error / difference + 0x1p-48) * along.lpNorm<1>() + 0x1p-48 * u.y.lpNorm<1>();
  const bool is_border = j == Frame::none;
  if (is_border) radius2_ = std::max(radius2_, y.squaredNorm() + tolerance * (2 * y.lpNorm<1>() + tolerance));
  if (is_border && division_) return true;
  corners_.add({y, tolerance, is_border ? Frame::none : i});
  on_edge_.add({label_of(i, j), static_cast<Node>(links_.size())});
  links_.add({unlinked, unlinked});
  return true;
}

bool Flood::add_vertex(Frame::Slot s) {
  if (s >= vertex_seen_.size()) vertex_seen_.resize(s + 64, 0);
  if (vertex_seen_[s] == trace_) return true;
  vertex_seen_[s] = trace_;
  const Frame::Vertex& v = frame_.vertex(s);
  const int nearest = division_ ? frame_.nearest(v) : Frame::none;
  if (nearest < 0) return false;
  radius2_ = std::max(radius2_, v.y.squaredNorm());
  corners_.add({v.y, 0, nearest});
  return true;
}

void Flood::add_end(Facet& facet, std::int32_t label, Node node) {
  ends_.add({label, node, facet.first_end});
  facet.first_end = static_cast<std::int32_t>(ends_.size()) - 1;
}

bool Flood::add_end(FacetId t, int i, int j) {
  if (!meets(t)) return false;
  links_of_ends_.add(unlinked);
  add_end(facets_[slot_of_[t]], label_of(i, j), -static_cast<Node>(links_of_ends_.size()));
  return true;
}

bool Flood::is_complete() {
  for (const Facet& facet : facets_.items())
    if (!join_ends(facet)) return false;
  std::size_t passed = 0;
  for (std::size_t i = 0; i < links_of_ends_.size(); ++i) {  // each chain from both of its ends
    Node before = -1 - static_cast<Node>(i), at = links_of_ends_[i];
    while (at >= 0) {
      if (++passed > 2 * links_.size()) return false;
      const auto& [one, two] = links_[static_cast<std::size_t>(at)];
      const Node onward = one == before ? two : one;
      if (onward == unlinked) return false;
      before = at;
      at = onward;
    }
  }
  return passed == 2 * links_.size();
}

/// The two ends of each label in a facet belong together.
bool Flood::join_ends(const Facet& facet) {
  if (facet.first_end < 0 && !division_)
    return std::ranges::all_of(facet.corners, [&](Frame::Slot s) { return frame_.vertex(s).owned(); });
  const auto set = [&](Node from, Node to) {
    if (from < 0) {
      links_of_ends_[static_cast<std::size_t>(-1 - from)] = to;
    } else {
      std::array<Node, 2>& links = links_[static_cast<std::size_t>(from)];
      (links[0] == unlinked ? links[0] : links[1]) = to;
    }
  };
  int waiting = 0;
  ++stamp_;
  for (std::int32_t e = facet.first_end; e >= 0; e = ends_[static_cast<std::size_t>(e)].next) {
    const auto& [label, node, next] = ends_[static_cast<std::size_t>(e)];
    Waiting& other = waiting_[static_cast<std::size_t>(label)];
    if (other.stamp != stamp_) {
      other = {stamp_, node, false};
      ++waiting;
      continue;
    }
    if (other.is_joined) return false;
    other.is_joined = true;
    --waiting;
    set(node, other.node);
    set(other.node, node);
  }
  return waiting == 0;
}

}  // namespace geom
