#include "tools/own_vertices.h"

#include <algorithm>
#include <optional>

#include "fpo/surface/barycentric.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"
#include "io/mesh_io.h"

namespace tools {

using geom::Vec3;
using geom::VertexId;

namespace {

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

geom::Table<VertexId, VertexId> own_vertices(const geom::Table<VertexId, Vec3>& places,
                                             const geom::Table<VertexId, Vec3>& file) {
  std::vector<VertexId> order;
  for (std::size_t v = 0; v < file.size(); ++v) order.emplace_back(v);
  std::ranges::stable_sort(order, [&](VertexId a, VertexId b) { return before(file[a], file[b]); });
  geom::Table<VertexId, VertexId> own;
  for (const Vec3& place : places) {
    const auto at = std::lower_bound(order.begin(), order.end(), place,
                                     [&](VertexId v, const Vec3& x) { return before(file[v], x); });
    own.push_back(at != order.end() && file[*at] == place ? *at : VertexId());
  }
  return own;
}

std::vector<io::MappedPoint> own_places(const std::filesystem::path& file, const geom::TriMesh& input,
                                        const std::vector<fpo::SurfaceSample>& samples,
                                        std::size_t& elsewhere) {
  std::size_t repeated = 0;
  const geom::TriMesh own = io::read_mesh(file, repeated);
  const geom::Table<VertexId, VertexId> vertex = own_vertices(input.vertices(), own.vertices());
  const std::vector<Vec3> barycentric = fpo::barycentric_coordinates(input, samples);
  const double factor = geom::factor_to_unit_box(own);
  std::optional<geom::AabbTree> tree;
  std::vector<io::MappedPoint> points;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    io::MappedPoint point{input.facet(samples[i].facet), barycentric[i]};
    for (VertexId& v : point.vertices) v = vertex[v];
    if (!std::ranges::all_of(point.vertices, &VertexId::valid)) {
      if (!tree) tree.emplace(geom::scaled(own, factor));
      const geom::AabbTree::Closest closest = tree->closest(factor * samples[i].position);
      point = {own.facet(closest.facet), closest.barycentric};
      ++elsewhere;
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace tools
