#include "fpo/surface/curvature.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "../../fixtures/parametric.h"
#include "../../fixtures/surfaces.h"
#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"

using fpo::curvature_size;
using fpo::max_curvature;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

TriMesh mapped(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& map) {
  Table<VertexId, Vec3> vertices = mesh.vertices();
  for (Vec3& v : vertices) v = map(v);
  return TriMesh(std::move(vertices), mesh.facets());
}

/// Relative errors of the larger principal curvature; ascending.
std::vector<double> errors(const TriMesh& mesh, const std::function<double(const Vec3&)>& exact,
                           int rings = 2) {
  const auto curvature = max_curvature(mesh, rings);
  std::vector<double> result;
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    result.push_back(std::abs(curvature[v] / exact(mesh.position(v)) - 1));
  std::ranges::sort(result);
  return result;
}

double median(const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; }

double one(const Vec3&) { return 1; }

}  // namespace

TEST_CASE("curvature: sphere, torus, open cylinder and saddle, meshed regularly or with folds") {
  CHECK(errors(geom::make_shape("sphere", 10), one).back() < 0.03);
  for (const double jitter : {0.0, 0.3, 0.45}) {
    CAPTURE(jitter);
    const TriMesh torus = fixtures::torus(1, 0.4, {60, 30, true, true, jitter});
    CHECK(errors(torus, [](const Vec3&) { return 2.5; }).back() < 0.2);

    const TriMesh tube = fixtures::parametric({40, 20, true, false, jitter}, [](double u, double v) {
      return Vec3(std::cos(2 * std::numbers::pi * u), std::sin(2 * std::numbers::pi * u), 3 * v);
    });
    CHECK(errors(tube, one).back() < 0.1);

    // z = x^2 - y^2 / 2, by the two fundamental forms.
    const TriMesh saddle = fixtures::parametric({30, 30, false, false, jitter}, [](double u, double v) {
      const double x = 2 * u - 1, y = 2 * v - 1;
      return Vec3(x, y, x * x - y * y / 2);
    });
    const auto of_saddle = errors(saddle, [](const Vec3& p) {
      Eigen::Matrix2d first, second;
      first << 1 + 4 * p.x() * p.x(), -2 * p.x() * p.y(), -2 * p.x() * p.y(), 1 + p.y() * p.y();
      second << 2, 0, 0, -1;
      second /= std::sqrt(1 + 4 * p.x() * p.x() + p.y() * p.y());
      const Eigen::Matrix2d shape = first.inverse() * second;
      const double mean = shape.trace() / 2;
      return std::abs(mean) + std::sqrt(std::max(mean * mean - shape.determinant(), 0.0));
    });
    CHECK(median(of_saddle) < 0.04);
    CHECK(of_saddle.back() < 0.35);
  }
}

TEST_CASE("curvature: converges as the mesh becomes finer") {
  double previous = 1;
  for (const int n : {16, 32, 64}) {
    const double error =
        median(errors(fixtures::torus(1, 0.4, {2 * n, n, true, true, 0.2}), [](const Vec3&) { return 2.5; }));
    CHECK(error < 0.5 * previous);
    previous = error;
  }
}

TEST_CASE("curvature: more rings smooth noise out") {
  const TriMesh sphere = geom::make_shape("sphere", 20);  // edges of about 0.06
  geom::Rng rng(3);
  const TriMesh noisy =
      mapped(sphere, [&](const Vec3& x) { return Vec3(x * (1 + rng.uniform(-0.001, 0.001))); });
  const double with_1 = median(errors(noisy, one, 1)), with_2 = median(errors(noisy, one, 2));
  const double with_3 = median(errors(noisy, one, 3));
  CHECK(with_2 < 0.5 * with_1);
  CHECK(with_3 < 0.7 * with_2);
  CHECK(with_3 < 0.1);
}

TEST_CASE("curvature: moves with the surface, inversely to its scale, whatever the order or orientation") {
  const TriMesh mesh = geom::make_shape("blob", 10, 3);
  const auto curvature = max_curvature(mesh);
  const Eigen::AngleAxisd turn(0.8, Vec3(1, -2, 3).normalized());
  const auto moved =
      max_curvature(mapped(mesh, [&](const Vec3& x) { return Vec3(turn * x * 0.01 + Vec3(3, 4, 5)); }));
  std::vector<VertexId> new_id;
  const auto shuffled = max_curvature(fixtures::reordered(mesh, new_id));
  Table<geom::FacetId, TriMesh::Facet> turned_over = mesh.facets();
  for (TriMesh::Facet& f : turned_over) std::swap(f[0], f[1]);
  const auto inside_out = max_curvature(TriMesh(mesh.vertices(), turned_over));
  double worst = 0;
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    for (const double other : {moved[v] * 0.01, shuffled[new_id[v.index()]], inside_out[v]})
      worst = std::max(worst, std::abs(other / curvature[v] - 1));
  CHECK(worst < 1e-6);
}

TEST_CASE("curvature: flat pieces have none, creases much, vertices without facets none") {
  for (const double k : max_curvature(fixtures::tilted_square(7))) CHECK(k < 1e-9);
  for (const double k : max_curvature(geom::make_shape("triangle", 1))) CHECK(k < 1e-9);
  const TriMesh box = fixtures::box(Vec3(1, 1, 1), 10);
  const auto curvature = max_curvature(box);
  for (VertexId v(0); v.index() < box.num_vertices(); v = VertexId(v.value + 1)) {
    const Vec3 to_side = box.position(v).cwiseMin(Vec3(1, 1, 1) - box.position(v));
    std::array<double, 3> sorted{to_side.x(), to_side.y(), to_side.z()};
    std::ranges::sort(sorted);
    if (sorted[1] > 0.25) CHECK(curvature[v] < 1e-9);  // two rings are on one side
    if (sorted[1] == 0) CHECK(curvature[v] > 1);
  }
  const TriMesh unused({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5), Vec3(2, 0, 0)},
                       {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(1), VertexId(4)}});
  for (const double k : max_curvature(unused)) CHECK(k < 1e-9);
  CHECK(max_curvature(TriMesh()).empty());
}

TEST_CASE("curvature size: the inverse, clamped") {
  const TriMesh mesh = geom::make_shape("blob", 10, 3);
  const auto curvature = max_curvature(mesh);
  const auto size = curvature_size(mesh, {.min = 0.5, .max = 0.9});
  bool equal = true;
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    equal &= size[v] == std::clamp(1 / curvature[v], 0.5, 0.9);
  CHECK(equal);
  CHECK(std::ranges::max(curvature_size(fixtures::tilted_square(3), {.max = 7})) == 7);
  CHECK_THROWS_AS(curvature_size(mesh, {.min = -1}), geom::InputError);
  CHECK_THROWS_AS(curvature_size(mesh, {.min = 2, .max = 1}), geom::InputError);
  CHECK_THROWS_AS(curvature_size(mesh, {.max = std::nan("")}), geom::InputError);
  CHECK_THROWS_AS(curvature_size(mesh, {.rings = 0}), geom::InputError);
}
