#include "fpo/surface/curvature.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/check.h"

namespace fpo {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Rings are added until they hold this many vertices besides the first: one for each coefficient but the
/// height.
constexpr std::size_t enough = 6;
constexpr int more_rings = 3;
/// Combinations of coefficients that the vertices determine worse than others by this factor, squared.
constexpr double undetermined = 1e-5;

/// The vertices joined to each vertex by an edge, and rings of them.
class Rings {
 public:
  explicit Rings(const TriMesh& mesh)
      : first_(mesh.num_vertices() + 1, 0), seen_(mesh.num_vertices(), VertexId()) {
    for (const TriMesh::Facet& f : mesh.facets())
      for (const VertexId v : f) first_[v.index() + 1] += 2;
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    joined_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const TriMesh::Facet& f : mesh.facets())
      for (std::size_t i = 0; i < 3; ++i)
        for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) joined_[next[f[i].index()]++] = f[j];
  }

  /// v and the vertices of `rings` rings about it, and of some more if these are few.
  const std::vector<VertexId>& about(VertexId v, int rings) {
    found_.assign(1, v);
    seen_[v] = v;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings + more_rings; ++ring) {
      if (ring >= rings && found_.size() > enough) break;
      const std::size_t end = found_.size();
      for (; begin < end; ++begin) add_joined(found_[begin], v);
    }
    return found_;
  }

 private:
  void add_joined(VertexId u, VertexId center) {
    for (std::size_t k = first_[u.index()]; k < first_[u.index() + 1]; ++k) {
      if (seen_[joined_[k]] == center) continue;
      seen_[joined_[k]] = center;
      found_.push_back(joined_[k]);
    }
  }

  std::vector<std::size_t> first_;  ///< by vertex, into joined_
  std::vector<VertexId> joined_;    ///< each twice where two facets share the edge
  Table<VertexId, VertexId> seen_;  ///< the last vertex about which this one was found
  std::vector<VertexId> found_;
};

/// The vector area of the facets around: where these fold over on a flat piece, they cancel out.
Table<VertexId, Vec3> vertex_normals(const TriMesh& mesh) {
  Table<VertexId, Vec3> normals(mesh.num_vertices(), Vec3(0, 0, 0));
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh.facet(t)) normals[v] += mesh.normal(t);
  return normals;
}

/// The solution of least magnitude of the normal equations A c = b, without the combinations of coefficients
/// that A says little about.
Vec6 solve(const Mat6& a, const Vec6& b) {
  const Eigen::SelfAdjointEigenSolver<Mat6> eigen(a);
  const double least = undetermined * eigen.eigenvalues()[5];
  Vec6 inverse = Vec6::Zero();
  for (int i = 0; i < 6; ++i)
    if (eigen.eigenvalues()[i] > least) inverse[i] = 1 / eigen.eigenvalues()[i];
  return eigen.eigenvectors() * (inverse.asDiagonal() * (eigen.eigenvectors().transpose() * b));
}

/// Of the graph of c0 + c1 x + c2 y + (c3 x^2 + 2 c4 x y + c5 y^2) / 2 at x = y = 0: mean curvature H and
/// Gauss curvature K by the first and second fundamental forms; the principal ones are H +- sqrt(H^2 - K).
double max_curvature_of_graph(const Vec6& c) {
  const double slope = 1 + c[1] * c[1] + c[2] * c[2];
  const double gauss = (c[3] * c[5] - c[4] * c[4]) / (slope * slope);
  const double mean = ((1 + c[2] * c[2]) * c[3] - 2 * c[1] * c[2] * c[4] + (1 + c[1] * c[1]) * c[5]) /
                      (2 * slope * std::sqrt(slope));
  return std::abs(mean) + std::sqrt(std::max(mean * mean - gauss, 0.0));
}

/// about[0] is the vertex itself. Lengths are measured in the mean distance of the others.
double max_curvature_at(const TriMesh& mesh, std::span<const VertexId> about, const Vec3& normal) {
  const Vec3& origin = mesh.position(about[0]);
  double unit = 0;
  for (const VertexId u : about.subspan(1))
    unit += (mesh.position(u) - origin).norm() / static_cast<double>(about.size() - 1);
  if (!(unit > 0) || !(normal.norm() > 0)) return 0;
  const Vec3 n = normal.normalized(), x = n.unitOrthogonal(), y = n.cross(x);
  Mat6 a = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  for (const VertexId u : about) {
    const Vec3 d = (mesh.position(u) - origin) / unit;
    const double dx = d.dot(x), dy = d.dot(y), weight = 1 / (1 + d.squaredNorm());
    const Vec6 terms(1, dx, dy, dx * dx / 2, dx * dy, dy * dy / 2);
    a += weight * terms * terms.transpose();
    b += weight * d.dot(n) * terms;
  }
  return max_curvature_of_graph(solve(a, b)) / unit;
}

}  // namespace

Table<VertexId, double> max_curvature(const TriMesh& mesh, int rings) {
  geom::require(rings >= 1 && rings <= 10, "the number of rings must be 1 to 10");
  Rings neighbourhood(mesh);
  const Table<VertexId, Vec3> normals = vertex_normals(mesh);
  Table<VertexId, double> curvature;
  curvature.reserve(mesh.num_vertices());
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    curvature.push_back(max_curvature_at(mesh, neighbourhood.about(v, rings), normals[v]));
  return curvature;
}

Table<VertexId, double> curvature_size(const TriMesh& mesh, const CurvatureSizeOptions& options) {
  geom::require(options.min >= 0 && options.min <= options.max,
                "the least curvature size must be at least 0 and at most the largest");
  Table<VertexId, double> size = max_curvature(mesh, options.rings);
  for (double& s : size) s = std::clamp(1 / s, options.min, options.max);
  return size;
}

}  // namespace fpo
