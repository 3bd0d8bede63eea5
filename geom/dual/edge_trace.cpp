#include "geom/dual/edge_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/dual/lead.h"

namespace geom {
namespace {

constexpr std::size_t most_facets = 32;

}  // namespace

// It leaves a facet where, along the facet's border, the left site becomes the nearer one: from u to v.
// Across, the edge runs from v to u, and the third corner w tells which of the two others is next.
TracedEdge::Extent extent_of_edge(const TriMesh& mesh, const WeightedPoint3& left,
                                  const WeightedPoint3& right, const TracedEdge& edge) {
  const TracedEdge::Extent unknown{std::numeric_limits<double>::infinity(), Vec3(0, 0, 0)};
  const Vec3 start = edge.start - left.position, end = edge.end - left.position;
  TracedEdge::Extent extent{std::max(start.squaredNorm(), end.squaredNorm()), Vec3(0, 0, 0)};
  FacetId t = edge.from;
  Vec3 last = start;
  VertexId u, v;
  Sure at_u{0, 0}, at_v{0, 0};
  for (std::size_t step = 0; t != edge.to; ++step) {
    if (step == most_facets || !t.valid()) return unknown;
    const TriMesh::Facet& corners = mesh.facet(t);
    int e = 0;
    if (step == 0) {
      std::array<Sure, 3> lead;
      for (std::size_t i = 0; i < 3; ++i)
        if (lead[i] = lead_of(left, right, mesh.position(corners[i]), 0); !lead[i].certain()) return unknown;
      const auto leaves = [&](std::size_t i) {
        return lead[i].value < 0 && lead[i == 2 ? 0 : i + 1].value > 0;
      };
      while (e < 3 && !leaves(static_cast<std::size_t>(e))) ++e;
      if (e == 3) return unknown;
      at_u = lead[static_cast<std::size_t>(e)];
      at_v = lead[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
    } else {
      std::size_t w = 0;  // the corner that is neither u nor v; before it comes u
      while (corners[w] == u || corners[w] == v) ++w;
      if (corners[w == 0 ? 2 : w - 1] != u) return unknown;  // the facet is turned round
      const Sure at_w = lead_of(left, right, mesh.position(corners[w]), 0);
      if (!at_w.certain()) return unknown;
      e = static_cast<int>(at_w.value > 0 ? (w == 0 ? 2 : w - 1) : w);  // from u to w, or from w to v
      (at_w.value > 0 ? at_v : at_u) = at_w;
    }
    u = corners[static_cast<std::size_t>(e)];
    v = corners[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
    const Vec3 &a = mesh.position(u), &b = mesh.position(v);
    const Vec3 z = a + at_u.value / (at_u.value - at_v.value) * (b - a) - left.position;
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
