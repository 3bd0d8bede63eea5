#include "fpo/features/corner_angles.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "geom/mesh/angles.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

using CurveEdge = std::pair<VertexId, VertexId>;

std::vector<CurveEdge> curve_edges(const Features& features) {
  std::vector<CurveEdge> edges;
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t i = 0; i < curve.facets.size(); ++i)
      edges.emplace_back(std::minmax(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()]));
  std::ranges::sort(edges);
  return edges;
}

/// The corner of a facet at a vertex.
int corner_of(const TriMesh& mesh, FacetId t, VertexId v) {
  const TriMesh::Facet& f = mesh.facet(t);
  return f[0] == v ? 0 : f[1] == v ? 1 : 2;
}

}  // namespace

// From each edge of a feature that begins a facet at a vertex, around it to the next such edge.
CornerAngles corner_angles(const TriMesh& mesh, const Features& features) {
  const std::vector<CurveEdge> edges = curve_edges(features);
  const auto is_edge = [&](VertexId a, VertexId b) {
    return std::ranges::binary_search(edges, CurveEdge(std::minmax(a, b)));
  };
  CornerAngles result;
  constexpr double degree = std::numbers::pi / 180;
  for (FacetId first(0); !edges.empty() && first.index() < mesh.num_facets();
       first = FacetId(first.value + 1))
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId v = mesh.facet(first)[i];
      if (!is_edge(v, mesh.facet(first)[(i + 1) % 3])) continue;
      double angle = 0;
      FacetId t = first;
      for (int at = static_cast<int>(i); angle < degree * std::max(result.smallest, 30.0);
           at = corner_of(mesh, t, v)) {
        angle += geom::corner_angle(mesh, t, at);
        if (is_edge(v, mesh.facet(t)[static_cast<std::size_t>((at + 2) % 3)])) {
          if (!(angle > 0)) break;  // the facets have no area
          result.smallest = std::min(result.smallest, angle / degree);
          result.below_30 += angle < 30 * degree;
          break;
        }
        t = mesh.across(t, (at + 2) % 3);
        if (!t.valid() || t == first) break;
      }
    }
  return result;
}

}  // namespace fpo
