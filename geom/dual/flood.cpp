#include "geom/dual/flood.h"

#include <algorithm>
#include <cmath>

namespace geom {

void Flood::clear() {
  facets_.clear();
  corners_.clear();
}

bool Flood::trace(std::span<const FacetId> from, bool division) {
  clear();
  ends_.clear();
  radius2_ = 0;
  division_ = division;
  ++trace_;
  for (const FacetId t : from) facets_.meet(t, vertices_);
  for (MetFacets::Slot slot = 0; slot < facets_.size(); ++slot)
    for (std::size_t e = 0; e < 3; ++e)
      if (!facets_[slot].done[e] && !trace_edge(slot, e)) return false;
  return true;
}

/// Looks at an edge of a facet that is met. False if something is not certain.
bool Flood::trace_edge(MetFacets::Slot slot, std::size_t e) {
  const FrameVertices::Slot from = facets_[slot].corners[e], to = facets_[slot].corners[e == 2 ? 0 : e + 1];
  EdgePart part;
  {
    const FrameVertices::Vertex &u = vertices_[from], &v = vertices_[to];
    if (!u.sure || !v.sure) return false;
    if ((u.beaten_by & v.beaten_by) != 0) return true;  // one and the same site is nearer all along
    const Meets has_part = find_part(u, v, part);
    if (has_part != Meets::yes) return has_part == Meets::no;
  }
  const FacetId across = mesh_.across(facets_[slot].id, static_cast<int>(e));
  if (!across.valid()) return false;
  const MetFacets::Slot other = facets_.meet(across, vertices_);
  const FrameVertices::Vertex &u = vertices_[from], &v = vertices_[to];  // meet() may have moved them
  const std::size_t back = facets_[other].edge(to, from);
  if (back == 3) return false;  // the other facet runs the other way round
  facets_[other].done[back] = true;
  on_edge_.clear();
  if (part.begin != EdgePart::at_vertex && !add_point(u, v, part.begin, Frame::none)) return false;
  if (part.end != EdgePart::at_vertex && !add_point(u, v, part.end, Frame::none)) return false;
  if (division_ && !divide(u, v, part)) return false;
  if ((u.owned() && !add_vertex(from)) || (v.owned() && !add_vertex(to))) return false;
  for (std::size_t i = 0; i < on_edge_.size(); ++i) {
    const auto& [a, b, node] = on_edge_[i];
    ends_.add(facets_[slot].ends, a, b, node);
    ends_.add(facets_[other].ends, a, b, node);
  }
  return true;
}

bool Flood::divide(const FrameVertices::Vertex& u, const FrameVertices::Vertex& v, const EdgePart& part) {
  if (!find_owners(vertices_, u, v, part, owners_)) return false;
  for (std::size_t k = 0; k + 1 < owners_.size(); ++k)
    if (!add_point(u, v, owners_[k], owners_[k + 1])) return false;
  return true;
}

/// The point of the edge where sites i and j (none: the origin) are equally near. In parameter t = f(u) /
/// (f(u) - f(v)) it is off by (1.01 E + E') / |f(u) - f(v)| and roundings at most, E and E' the errors of f.
/// Points of the cell's border are ends of the cell's own edges, but not of those of the division.
bool Flood::add_point(const FrameVertices::Vertex& u, const FrameVertices::Vertex& v, int i, int j) {
  const double fu = u.g[i] - u.g[j], fv = v.g[i] - v.g[j];
  const double difference = std::abs(fu - fv), error = 4 * (u.error + v.error);
  if (!(difference > 4 * error)) return false;
  const double t = std::clamp(std::abs(fu) / difference, 0.0, 1.0);
  const Vec3 along = v.y - u.y;
  const double rise = v.rise - u.rise;
  const Frame::Place at{u.y + t * along, u.rise + t * rise};
  const double off = (2 * error / difference + 0x1p-48) * (along.lpNorm<1>() + std::abs(rise)) +
                     0x1p-48 * (u.y.lpNorm<1>() + std::abs(u.rise));
  const bool is_border = j == Frame::none;
  if (is_border)
    radius2_ =
        std::max(radius2_, at.squaredNorm() + off * (2 * (at.y.lpNorm<1>() + std::abs(at.rise)) + off));
  if (is_border && division_) return true;
  corners_.add({at, off, is_border ? Frame::none : i});
  on_edge_.add({i, j, ends_.add_point()});
  return true;
}

bool Flood::add_new_vertex(FrameVertices::Slot s) {
  if (s >= vertex_seen_.size()) vertex_seen_.resize(s + 64, 0);
  vertex_seen_[s] = trace_;
  const FrameVertices::Vertex& v = vertices_[s];
  const int nearest = division_ ? vertices_.nearest(v) : Frame::none;
  if (nearest < 0) return false;
  radius2_ = std::max(radius2_, v.squaredNorm());
  corners_.add({v, 0, nearest});
  return true;
}

bool Flood::add_end(FacetId t, int i, int j) {
  if (!facets_.has(t)) return false;
  ends_.add(facets_[facets_.slot(t)].ends, i, j, ends_.add_corner());
  return true;
}

bool Flood::is_complete() {
  for (const MetFacets::Facet& facet : facets_.items()) {
    const bool is_joined =
        facet.ends == SegmentEnds::empty && !division_
            ? std::ranges::all_of(facet.corners, [&](FrameVertices::Slot s) { return vertices_[s].owned(); })
            : ends_.join(facet.ends);
    if (!is_joined) return false;
  }
  return ends_.are_all_on_chains();
}

}  // namespace geom
