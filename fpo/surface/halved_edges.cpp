#include "fpo/surface/halved_edges.h"

#include <algorithm>
#include <cmath>

#include "geom/mesh/scaling.h"

namespace fpo {

using geom::Vec3;
using geom::VertexId;

std::uint64_t edge_key(VertexId a, VertexId b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low.value) << 32 | static_cast<std::uint64_t>(high.value);
}

HalvedEdges::HalvedEdges(const geom::TriMesh& mesh, const Sizing& sizing, double most)
    : positions_(mesh.vertices()), most_(most) {
  for (VertexId v(0); v.index() < positions_.size(); v = VertexId(v.value + 1)) h_.push_back(sizing.at(v));
}

bool HalvedEdges::is_long(VertexId a, VertexId b) const {
  return (positions_[a] - positions_[b]).norm() > most_ * std::min(h_[a], h_[b]);
}

double HalvedEdges::excess(const geom::TriMesh::Facet& f) const {
  const double longest2 = std::max({length2(f[0], f[1]), length2(f[1], f[2]), length2(f[2], f[0])});
  return std::sqrt(longest2) / (most_ * std::min({h_[f[0]], h_[f[1]], h_[f[2]]}));
}

VertexId HalvedEdges::middle(VertexId a, VertexId b) {
  if (!is_long(a, b)) return {};
  const auto [at, is_new] = middles_.try_emplace(edge_key(a, b), positions_.next_id());
  if (is_new) middle_within(std::min(a, b), std::max(a, b));
  return at->second;
}

VertexId HalvedEdges::middle_within(VertexId a, VertexId b) {
  const VertexId v = positions_.next_id();
  const Vec3 p = positions_[a], q = positions_[b];
  positions_.push_back(geom::snapped(Vec3(0.5 * p + 0.5 * q)));
  h_.push_back(0.5 * h_[a] + 0.5 * h_[b]);
  return v;
}

}  // namespace fpo
