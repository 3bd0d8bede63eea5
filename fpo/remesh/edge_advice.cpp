#include "fpo/remesh/edge_advice.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace fpo {

using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double least_ratio = 1.1, most_ratio = 6;  // of the edges' lengths to those that would do

/// An edge over twice the distance of its middle from another vertex.
double crowding(const TriMesh& mesh, VertexId a, VertexId b) {
  const Vec3 middle = (mesh.position(a) + mesh.position(b)) / 2;
  const double size2 = (mesh.position(b) - mesh.position(a)).squaredNorm();
  double nearest2 = size2;
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    if (v != a && v != b) nearest2 = std::min(nearest2, (mesh.position(v) - middle).squaredNorm());
  return nearest2 > 0 ? std::clamp(std::sqrt(size2 / nearest2) / 2, least_ratio, most_ratio) : most_ratio;
}

}  // namespace

EdgeAdvice edge_advice(const TriMesh& remesh, const FeatureSamples& features) {
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const TriMesh::Facet& f : remesh.facets())
    for (std::size_t e = 0; e < 3; ++e) edges.insert(std::minmax(f[e], f[(e + 1) % 3]));
  EdgeAdvice result;
  double most = 0;
  for (const std::vector<SiteId>& chain : features.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const VertexId a(chain[i].value), b(chain[i + 1].value);
      if (edges.contains(std::minmax(a, b))) continue;
      if (most == 0) result.first = (remesh.position(a) + remesh.position(b)) / 2;
      most = std::max(most, crowding(remesh, a, b));
    }
  result.samples = static_cast<std::size_t>(static_cast<double>(remesh.num_vertices()) * most * most);
  return result;
}

}  // namespace fpo
