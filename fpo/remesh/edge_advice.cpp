#include "fpo/remesh/edge_advice.h"

#include <algorithm>
#include <cmath>

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

EdgeAdvice edge_advice(const TriMesh& remesh, std::span<const std::pair<SiteId, SiteId>> missing) {
  if (missing.empty()) return {};
  double most = 0;
  for (const auto& [a, b] : missing)
    most = std::max(most, crowding(remesh, VertexId(a.value), VertexId(b.value)));
  const auto& [a, b] = missing.front();
  return {(remesh.position(VertexId(a.value)) + remesh.position(VertexId(b.value))) / 2,
          static_cast<std::size_t>(static_cast<double>(remesh.num_vertices()) * most * most)};
}

}  // namespace fpo
