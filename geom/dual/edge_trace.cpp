#include "geom/dual/edge_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/dual/lead.h"

namespace geom {
namespace {

constexpr std::size_t most_facets = 32;

/// By how much the left site, the origin of y, is nearer than the right one: c - 2 d.y, with the error of
/// frame.h.
class LeftLead {
 public:
  LeftLead(const WeightedPoint3& left, const WeightedPoint3& right) : d_(right.position - left.position) {
    const double d2 = d_.squaredNorm(), heavier = right.weight - left.weight;
    c_ = d2 - heavier;
    error_ = 0x1p-49 * (d2 + std::abs(heavier));
    error_in_y_ = 0x1p-49 * std::sqrt(d2);
  }
  Sure at(const Vec3& y) const {
    return {c_ - 2 * (d_[0] * y[0] + d_[1] * y[1] + d_[2] * y[2]),
            error_ + error_in_y_ * (std::abs(y[0]) + std::abs(y[1]) + std::abs(y[2]))};
  }

 private:
  Vec3 d_;
  double c_, error_, error_in_y_;
};

}  // namespace

// It leaves a facet where, along the facet's border, the left site becomes the nearer one: from u to v.
// Across, the edge runs from v to u, and the third corner w tells which of the two others is next.
TracedEdge::Extent extent_of_edge(const TriMesh& mesh, const WeightedPoint3& left,
                                  const WeightedPoint3& right, const TracedEdge& edge) {
  const TracedEdge::Extent unknown{std::numeric_limits<double>::infinity(), Vec3(0, 0, 0)};
  const Vec3 start = edge.start - left.position, end = edge.end - left.position;
  TracedEdge::Extent extent{std::max(start.squaredNorm(), end.squaredNorm()), Vec3(0, 0, 0)};
  if (edge.from == edge.to) return extent.far2 *= 1 + 1e-6, extent.twice_area = start.cross(end), extent;
  const LeftLead lead(left, right);
  FacetId t = edge.from;
  Vec3 last = start;
  struct Corner {
    VertexId id;
    Vec3 y;
    Sure lead;
  };
  const auto corner = [&](VertexId id) -> Corner {
    const Vec3 y = mesh.position(id) - left.position;
    return {id, y, lead.at(y)};
  };
  Corner u, v;
  for (std::size_t step = 0; t != edge.to; ++step) {
    if (step == most_facets || !t.valid()) return unknown;
    const TriMesh::Facet& corners = mesh.facet(t);
    int e = 0;
    if (step == 0) {  // mostly there is one edge of the surface to cross
      while (e < 2 && mesh.across(t, e) != edge.to) ++e;
      const auto at = [&](int i) { return corner(corners[static_cast<std::size_t>(i < 3 ? i : i - 3)]); };
      const auto leaves = [&] { return u.lead.negative() && v.lead.positive(); };
      u = at(e);
      v = at(e + 1);
      if (!leaves()) {
        const Corner first = u, w = at(e + 2);
        u = v, v = w, e = e == 2 ? 0 : e + 1;
        if (!leaves()) u = w, v = first, e = e == 2 ? 0 : e + 1;
        if (!leaves()) return unknown;
      }
    } else {
      std::size_t w = 0;  // the corner that is neither u nor v; before it comes u
      while (corners[w] == u.id || corners[w] == v.id) ++w;
      if (corners[w == 0 ? 2 : w - 1] != u.id) return unknown;  // the facet is turned round
      const Corner third = corner(corners[w]);
      if (!third.lead.certain()) return unknown;
      e = static_cast<int>(third.lead.value > 0 ? (w == 0 ? 2 : w - 1) : w);  // from u to w, or from w to v
      (third.lead.value > 0 ? v : u) = third;
    }
    const Vec3 z = u.y + u.lead.value / (u.lead.value - v.lead.value) * (v.y - u.y);
    extent.far2 = std::max(extent.far2, z.squaredNorm());
    extent.twice_area += last.cross(z);
    last = z;
    t = mesh.across(t, e);
  }
  extent.far2 *= 1 + 1e-6;
  extent.twice_area += last.cross(end);
  return extent;
}

}  // namespace geom
