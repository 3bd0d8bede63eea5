#include "geom/mesh/centring.h"

#include <cmath>

namespace geom {
namespace {

constexpr double far = 8;  // diagonals
constexpr double least_diagonal = 0x1p-880;

}  // namespace

Vec3 far_middle(const TriMesh& mesh) {
  Vec3 result(0, 0, 0);
  if (mesh.box().isEmpty()) return result;
  const double largest = mesh.box().sizes().maxCoeff();
  const double diagonal = largest * std::sqrt(3.0);  // at least; its square may over- or underflow
  if (!(largest > least_diagonal)) return result;
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = mesh.box().min()[axis] / 2 + mesh.box().max()[axis] / 2;
    if (std::abs(middle) > far * diagonal) result[axis] = middle;
  }
  return result;
}

TriMesh moved_by(const TriMesh& mesh, const Vec3& by) {
  Table<VertexId, Vec3> vertices = mesh.vertices();
  for (Vec3& v : vertices) v += by;
  return mesh.with_vertices(std::move(vertices));
}

}  // namespace geom
