#include "geom/mesh/scaling.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"

namespace geom {
namespace {

double largest_coordinate(const TriMesh& mesh) {
  if (mesh.box().isEmpty()) return 0;
  return std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
}

double factor_for(double largest) {
  if (largest == 0) return 1;
  require(largest >= 0x1p-900, "the surface is too small: no coordinate reaches 1.2e-271");
  require(largest <= 0x1p900, "the surface is too large: a coordinate exceeds 8.4e270");
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, -exponent);
}

template <class Map>
TriMesh mapped_vertices(const TriMesh& mesh, const Map& map) {
  Table<VertexId, Vec3> vertices = mesh.vertices();
  for (Vec3& v : vertices) v = map(v);
  return mesh.with_vertices(std::move(vertices));
}

}  // namespace

double factor_to_unit_box(const TriMesh& mesh) { return factor_for(largest_coordinate(mesh)); }

double factor_to_unit_box(const TriMesh& a, const TriMesh& b) {
  return factor_for(std::max(largest_coordinate(a), largest_coordinate(b)));
}

TriMesh scaled(const TriMesh& mesh, double factor) {
  return mapped_vertices(mesh, [&](const Vec3& v) { return Vec3(v * factor); });
}

TriMesh scaled_to_unit_box(const TriMesh& mesh, double factor) {
  return mapped_vertices(mesh, [&](const Vec3& v) { return snapped(Vec3(v * factor)); });
}

}  // namespace geom
