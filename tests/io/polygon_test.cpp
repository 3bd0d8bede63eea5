#include "io/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "doctest.h"

using geom::Vec3;

namespace {

Vec3 vector_area(const std::vector<Vec3>& p, int a, int b, int c) {
  const auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
  return (at(b) - at(a)).cross(at(c) - at(a)) / 2;
}

/// Star-shaped about the origin in the plane z = 0, with random radii: simple, with many reflex corners.
std::vector<Vec3> star(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  std::vector<Vec3> polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, r = radius(random);
    polygon.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  return polygon;
}

Eigen::Matrix3d random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

/// Twice the area by the shoelace formula.
double shoelace(const std::vector<Vec3>& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % p.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

void check_boundary(const std::vector<std::array<int, 3>>& triangles, int n) {
  // Each polygon edge lies in exactly one triangle, as directed; each diagonal once in either direction.
  std::vector<std::array<int, 2>> edges;
  for (const auto& [a, b, c] : triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  std::sort(edges.begin(), edges.end());
  CHECK(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
  for (const auto& [a, b] : edges) {
    const bool side = b == (a + 1) % n;
    CHECK(std::binary_search(edges.begin(), edges.end(), std::array{b, a}) == !side);
  }
}

}  // namespace

TEST_CASE("triangulate: simple polygons of any shape and direction are covered without folds") {
  std::mt19937 random(7);
  for (int n = 4; n <= 40; ++n)
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<Vec3> flat = star(random, n);
      const double twice_area = shoelace(flat);
      const Eigen::Matrix3d turn = random_rotation(random);
      std::vector<Vec3> polygon;
      for (const Vec3& p : flat) polygon.push_back(turn * p);
      const Vec3 normal = turn.col(2);
      const auto triangles = io::triangulate(polygon);
      REQUIRE(triangles.size() == static_cast<std::size_t>(n - 2));
      double sum = 0;
      for (const auto& [a, b, c] : triangles) {
        const double signed_area = vector_area(polygon, a, b, c).dot(normal);
        CHECK(signed_area > -1e-12);
        sum += signed_area;
      }
      CHECK(sum == doctest::Approx(twice_area / 2).epsilon(1e-9));
      check_boundary(triangles, n);
    }
}

TEST_CASE("triangulate: degenerate polygons still give n - 2 triangles on their own edges") {
  const std::vector<std::vector<Vec3>> polygons = {
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},             // bow-tie
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},             // a segment
      {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},  // a point
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}},             // a straight corner
      {{0, 0, 0}, {1e48, 0, 0}, {1e48, 1e48, 0}, {0, 1e48, 0}}};
  for (const auto& polygon : polygons) {
    const auto triangles = io::triangulate(polygon);
    CHECK(triangles.size() == polygon.size() - 2);
    check_boundary(triangles, static_cast<int>(polygon.size()));
  }
}

TEST_CASE("triangulate: a straight corner makes no flat triangle") {
  const std::vector<Vec3> polygon = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}};
  for (const auto& [a, b, c] : io::triangulate(polygon)) CHECK(vector_area(polygon, a, b, c).z() > 0);
}

TEST_CASE("triangulate: a long convex polygon takes linear time") {
  std::vector<Vec3> polygon;
  for (int i = 0; i < 200000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 200000;
    polygon.emplace_back(std::cos(angle), 0.3, std::sin(angle));
  }
  CHECK(io::triangulate(polygon).size() == 199998);
}

TEST_CASE("triangulate: the same triangles whatever the polygon's size") {
  std::mt19937 random(8);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Matrix3d turn = random_rotation(random);
    std::vector<Vec3> polygon = star(random, 12);
    for (Vec3& p : polygon) p = turn * p;
    const auto expected = io::triangulate(polygon);
    for (const int exponent : {-900, -500, 150}) {
      std::vector<Vec3> scaled = polygon;
      for (Vec3& p : scaled) p *= std::ldexp(1.0, exponent);
      CHECK(io::triangulate(scaled) == expected);
    }
  }
}
