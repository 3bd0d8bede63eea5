#include "tools/own_vertices.h"

#include <algorithm>
#include <utility>

namespace tools {

using geom::Vec3;
using geom::VertexId;

namespace {

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

geom::Table<VertexId, VertexId> own_vertices(const geom::TriMesh& mesh,
                                             const geom::Table<VertexId, Vec3>& file) {
  std::vector<VertexId> order;
  for (std::size_t v = 0; v < file.size(); ++v) order.emplace_back(v);
  std::ranges::stable_sort(order, [&](VertexId a, VertexId b) { return before(file[a], file[b]); });
  geom::Table<VertexId, VertexId> own;
  for (const Vec3& place : mesh.vertices()) {
    const auto at = std::lower_bound(order.begin(), order.end(), place,
                                     [&](VertexId v, const Vec3& x) { return before(file[v], x); });
    own.push_back(at != order.end() && file[*at] == place ? *at : VertexId());
  }
  return own;
}

}  // namespace tools
