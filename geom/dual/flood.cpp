#include "geom/dual/flood.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr std::int32_t unlinked = std::numeric_limits<std::int32_t>::min();

int next(int i) { return i == 2 ? 0 : i + 1; }

}  // namespace

bool Flood::trace(std::span<const FacetId> from, bool division) {
  facets_.clear();
  corners_.clear();
  vertex_seen_.clear();
  links_.clear();
  links_of_ends_.clear();
  ends_.clear();
  radius2_ = 0;
  division_ = division;
  for (const FacetId t : from) meet(t);
  for (std::uint32_t slot = 0; slot < facets_.size(); ++slot)
    for (int e = 0; e < 3; ++e)
      if (!facets_[slot].done[static_cast<std::size_t>(e)] && !trace_edge(slot, e)) return false;
  return true;
}

std::uint32_t Flood::meet(FacetId t) {
  if (meets(t)) return slot_of_[t];
  const auto slot = static_cast<std::uint32_t>(facets_.size());
  slot_of_[t] = slot;
  Facet& facet = facets_.emplace_back();
  facet.id = t;
  facet.done = {false, false, false};
  facet.first_end = -1;
  const TriMesh::Facet& corners = mesh_.facet(t);
  for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = frame_.at(corners[i]);
  return slot;
}

/// Looks at an edge of a facet that is met. False if something is not certain.
bool Flood::trace_edge(std::uint32_t slot, int e) {
  const Frame::Slot from = facets_[slot].corners[static_cast<std::size_t>(e)],
                    to = facets_[slot].corners[static_cast<std::size_t>(next(e))];
  if (!frame_.vertex(from).sure || !frame_.vertex(to).sure) return false;
  Interval part;
  const Meets has_part = interval(frame_.vertex(from), frame_.vertex(to), part);
  if (has_part != Meets::yes) return has_part == Meets::no;
  const FacetId t = facets_[slot].id, across = mesh_.across(t, e);
  if (!across.valid()) return false;
  const std::uint32_t other = meet(across);  // the frame may have moved its vertices
  const Frame::Vertex &u = frame_.vertex(from), &v = frame_.vertex(to);
  on_edge_.clear();
  if (part.begin != at_vertex && !add_point(u, v, part.begin, Frame::none, !division_)) return false;
  if (part.end != at_vertex && !add_point(u, v, part.end, Frame::none, !division_)) return false;
  if (division_ && !divide(u, v, part)) return false;
  for (const Frame::Slot s : {from, to})
    if (frame_.vertex(s).owned && !add_vertex(s)) return false;
  int back = -1;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (facets_[other].corners[at] == to && facets_[other].corners[static_cast<std::size_t>(next(i))] == from) back = i;
  }
  if (back < 0) return false;  // the other facet runs the other way round
  facets_[other].done[static_cast<std::size_t>(back)] = true;
  for (const auto& [label, node] : on_edge_) {
    add_end(facets_[slot], label, node);
    add_end(facets_[other], label, node);
  }
  return true;
}

// Along the edge from u to v, site i is nearer than the origin before t_i = g_i(u) / (g_i(u) - g_i(v)) if it is so at u,
// and after t_i if at v. So the origin has what lies after the last t_i of the former and before the first of the latter.
// t_i < t_j iff M_ij = g_i(u) g_j(v) - g_j(u) g_i(v) > 0 for two of the same kind, < 0 for two of different kinds.
Flood::Meets Flood::interval(const Frame::Vertex& u, const Frame::Vertex& v, Interval& out) const {
  out = {at_vertex, at_vertex};
  if ((u.beaten_by & v.beaten_by) != 0) return Meets::no;  // by one and the same site, all along
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

// The owners along the part without the origin: at a vertex the nearest site, where it is as near as site i that one. If
// both ends have one owner, all between has. Else the bisectors of consecutive owners meet the edge, and a third site
// that is nearer there comes between.
bool Flood::divide(const Frame::Vertex& u, const Frame::Vertex& v, const Interval& part) {
  if (part.begin == at_vertex && !u.sure_nearest) return false;
  if (part.end == at_vertex && !v.sure_nearest) return false;
  const int first = part.begin == at_vertex ? u.nearest : part.begin,
            last = part.end == at_vertex ? v.nearest : part.end;
  if (first == last) return true;
  owners_.assign({first, last});
  for (std::size_t k = 0; k + 1 < owners_.size();) {
    const int a = owners_[k], b = owners_[k + 1];
    if (!Frame::difference(u, a, b).negative() || !Frame::difference(v, a, b).positive()) return false;
    int between = -1;  // the nearest there: it owns something
    double most = 0;
    for (int c = 0; c < frame_.size(); ++c) {
      if (c == a || c == b) continue;
      if (Frame::difference(u, c, a).positive() && Frame::difference(v, c, a).positive()) continue;
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
    if (!add_point(u, v, owners_[k], owners_[k + 1], true)) return false;
  return true;
}

/// The point of the edge where sites i and j (none: the origin) are equally near. In parameter t = f(u) / (f(u) - f(v)) it
/// is off by (1.01 E + E') / |f(u) - f(v)| and roundings at most, E and E' the errors of f.
bool Flood::add_point(const Frame::Vertex& u, const Frame::Vertex& v, int i, int j, bool is_noted) {
  const double fu = Frame::value(u, i) - Frame::value(u, j), fv = Frame::value(v, i) - Frame::value(v, j);
  const double difference = std::abs(fu - fv), error = 4 * (u.error + v.error);
  if (!(difference > 4 * error)) return false;
  const double t = std::clamp(std::abs(fu) / difference, 0.0, 1.0);
  const Vec3 along = v.y - u.y;
  const Vec3 y = u.y + t * along;
  const double tolerance =
      (2 * error / difference + 0x1p-48) * (std::abs(along.x()) + std::abs(along.y()) + std::abs(along.z())) +
      0x1p-48 * (std::abs(u.y.x()) + std::abs(u.y.y()) + std::abs(u.y.z()));
  if (j == Frame::none) {
    const double far = y.norm() + tolerance;
    radius2_ = std::max(radius2_, far * far);
  }
  if (!is_noted) return true;
  corners_.push_back({y, tolerance, j == Frame::none ? Frame::none : i});
  on_edge_.push_back({label_of(i, j), static_cast<Node>(links_.size())});
  links_.push_back({unlinked, unlinked});
  return true;
}

bool Flood::add_vertex(Frame::Slot s) {
  const Frame::Vertex& v = frame_.vertex(s);
  if (s >= vertex_seen_.size()) vertex_seen_.resize(frame_.vertices().size(), 0);
  if (vertex_seen_[s]) return true;
  vertex_seen_[s] = 1;
  if (division_ && !v.sure_nearest) return false;
  radius2_ = std::max(radius2_, v.y.squaredNorm());
  corners_.push_back({v.y, 0, division_ ? v.nearest : Frame::none});
  return true;
}

void Flood::add_end(Facet& facet, std::int32_t label, Node node) {
  ends_.push_back({label, node, facet.first_end});
  facet.first_end = static_cast<std::int32_t>(ends_.size()) - 1;
}

bool Flood::add_end(FacetId t, int i, int j) {
  if (!meets(t)) return false;
  links_of_ends_.push_back(unlinked);
  add_end(facets_[slot_of_[t]], label_of(i, j), -static_cast<Node>(links_of_ends_.size()));
  return true;
}

bool Flood::is_complete() {
  for (const Facet& facet : facets_)
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
    return std::ranges::all_of(facet.corners, [&](Frame::Slot s) { return frame_.vertex(s).owned; });
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
