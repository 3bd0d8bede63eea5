#include "fpo/measure/quality.h"

#include <numbers>

#include "doctest.h"
#include "geom/check.h"
#include "tests/fixtures/surfaces.h"

namespace {

using doctest::Approx;
using fpo::Quality;
using fpo::quality;
using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;
using std::numbers::sqrt2, std::numbers::sqrt3;

TriMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return TriMesh({a, b, c}, {{VertexId(0), VertexId(1), VertexId(2)}});
}

/// k x k rhombi of two equilateral triangles of side 1.
TriMesh hexagonal_patch(int k) {
  Table<VertexId, Vec3> v;
  Table<FacetId, TriMesh::Facet> f;
  fixtures::add_grid(v, f, k, Vec3(0, 0, 0), Vec3(k, 0, 0), Vec3(-0.5 * k, sqrt3 / 2 * k, 0));
  return TriMesh(std::move(v), std::move(f));
}

/// All numbers, for comparisons.
std::array<double, 9> values(const Quality& q) {
  return {q.q_min,          q.q_avg,    q.theta_min, q.theta_max, q.theta_min_avg,
          q.theta_lt30_pct, q.v567_pct, q.delta,     q.delta_avg};
}

}  // namespace

TEST_CASE("quality: an equilateral triangle is perfect") {
  const TriMesh mesh = triangle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, sqrt3, 0));
  const Quality q = quality(mesh, mesh.area());
  CHECK(q.q_min == Approx(1));
  CHECK(q.q_avg == Approx(1));
  CHECK(q.theta_min == Approx(60));
  CHECK(q.theta_max == Approx(60));
  CHECK(q.theta_min_avg == Approx(60));
  CHECK(q.theta_lt30_pct == 0);
  CHECK(q.v567_pct == 0);                  // no interior vertex
  CHECK(q.delta == Approx(std::sqrt(6)));  // d_max^2 = 2 (sqrt 3) / (3 sqrt 3), edges 2
}

TEST_CASE("quality: right triangles") {
  const Quality half = quality(triangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)), 0.5);
  CHECK(half.q_min == Approx(6 / sqrt3 * 0.5 / ((2 + sqrt2) / 2 * sqrt2)));
  CHECK(half.theta_min == Approx(45));
  CHECK(half.theta_max == Approx(90));
  // 30 degrees are not below 30, in any position
  for (const double turn : {0.0, 0.3, 1.1, 2.9}) {
    const Eigen::AngleAxisd r(turn, Vec3(1, 2, 3).normalized());
    const TriMesh thirty =
        triangle(r * Vec3(0.1, 0.7, 0), r * Vec3(0.1 + sqrt3, 0.7, 0), r * Vec3(0.1, 1.7, 0));
    CHECK(quality(thirty, 1).theta_lt30_pct == 0);
  }
  const Quality flat = quality(triangle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0.5, 0)), 1);
  CHECK(flat.theta_lt30_pct == Approx(200.0 / 3));
}

TEST_CASE("quality: the hexagonal arrangement has delta 1 on its share of area, and valence 6") {
  const int k = 12;
  const TriMesh mesh = hexagonal_patch(k);
  const Quality q = quality(mesh, sqrt3 / 2 * (k + 1) * (k + 1));
  CHECK(q.delta == Approx(1));
  CHECK(q.delta_avg == Approx(1));
  CHECK(q.q_min == Approx(1));
  CHECK(q.v567_pct == 100);
  // four times the area, half of delta
  CHECK(quality(mesh, 4 * sqrt3 / 2 * (k + 1) * (k + 1)).delta == Approx(0.5));
}

TEST_CASE("quality: valences count edges of interior vertices only") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 1);  // valences 4 and 5, or 3, 6 and so on
  std::vector<int> degree(8, 0);
  for (const TriMesh::Facet& f : cube.facets())
    for (const VertexId v : f) ++degree[v.index()];  // closed: as many facets as edges
  const auto regular = std::ranges::count_if(degree, [](int d) { return d >= 5 && d <= 7; });
  CHECK(quality(cube, 6).v567_pct == Approx(100.0 * double(regular) / 8));
  // a fan of 4 about vertex 0: closed its center is interior, open it is not
  Table<VertexId, Vec3> v{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)};
  Table<FacetId, TriMesh::Facet> f;
  for (int i = 0; i < 4; ++i) f.push_back({VertexId(0), VertexId(1 + i), VertexId(1 + (i + 1) % 4)});
  CHECK(quality(TriMesh(v, f), 1).v567_pct == 0);
  v.push_back(Vec3(1, -1, 0));  // a fifth, between 4 and 1
  f.back() = {VertexId(0), VertexId(4), VertexId(5)};
  CHECK(quality(TriMesh(v, f), 1).v567_pct == 0);
  f.push_back({VertexId(0), VertexId(5), VertexId(1)});
  CHECK(quality(TriMesh(v, f), 1).v567_pct == 100);
}

TEST_CASE("quality: unchanged by motion, scale, and vertices that no facet uses") {
  const TriMesh mesh = fixtures::blob(5);
  const auto expected = values(quality(mesh, mesh.area()));
  const Eigen::AngleAxisd turn(0.8, Vec3(3, -1, 2).normalized());
  for (const double scale : {1e-6, 1.0, 1e9}) {
    Table<VertexId, Vec3> vertices;
    for (const Vec3& p : mesh.vertices()) vertices.push_back(scale * (turn * p + Vec3(1, 2, 3)));
    vertices.push_back(Vec3(0, 0, 0));
    const TriMesh moved(std::move(vertices), mesh.facets());
    const auto found = values(quality(moved, moved.area()));
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(found[i] == Approx(expected[i]).epsilon(1e-9));
  }
}

TEST_CASE("quality: defined on facets without area") {
  const TriMesh line = triangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0));
  const Quality q = quality(line, 0);
  CHECK(q.q_min == 0);
  CHECK(q.theta_min == 0);
  CHECK(q.theta_max == Approx(180));
  CHECK(q.delta == 0);
  for (const TriMesh& mesh : {line, triangle(Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)),
                              triangle(Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1))})
    for (const double area : {0.0, 1.0})
      for (const double value : values(quality(mesh, area))) CHECK(std::isfinite(value));
  CHECK_THROWS_AS(quality(TriMesh(), 1), geom::InputError);
}
