#include "fpo/features/feature_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "doctest.h"
#include "fpo/features/weak_curves.h"
#include "fpo/surface/sizing.h"
#include "geom/rng.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/polygonise.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

SamplingPlan plan_of(const TriMesh& mesh, std::size_t n) {
  return {n, hexagonal_spacing(mesh.area(), n), {}};
}

Features automatic(const TriMesh& mesh, std::size_t n) {
  return choose_features(mesh, automatic_features(), plan_of(mesh, n)).features;
}

TriMesh noisy(const TriMesh& mesh, double share_of_diagonal) {
  geom::Rng rng(7);
  return geom::mapped(mesh, [&](const Vec3& p) -> Vec3 {
    Vec3 q = p;
    for (int a = 0; a < 3; ++a) q[a] += share_of_diagonal * mesh.diagonal() * rng.uniform(-1, 1);
    return q;
  });
}

/// The cup of all points within half the wall's thickness of a profile that is turned about the z axis: a
/// bottom and a wall, with a sharp edge where they meet inside.
geom::ImplicitSurface cup_surface() {
  const auto from_segment = [](const geom::Vec2& p, const geom::Vec2& a, const geom::Vec2& b) {
    const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - s * (b - a)).norm();
  };
  const auto value = [from_segment](const Vec3& p) {
    const geom::Vec2 q(std::hypot(p.x(), p.y()), p.z()), corner(0.4, -0.5);
    return std::min(from_segment(q, {0, -0.5}, corner), from_segment(q, corner, {0.4, 0.5})) - 0.04;
  };
  const auto at = [value](const Vec3& p) -> geom::ImplicitSurface::Sample {
    constexpr double step = 1e-5;
    Vec3 gradient;
    for (int a = 0; a < 3; ++a)
      gradient[a] = (value(p + step * Vec3::Unit(a)) - value(p - step * Vec3::Unit(a))) / (2 * step);
    return {value(p), gradient};
  };
  return {at, {Vec3(-0.6, -0.6, -0.6), Vec3(0.7, 0.6, 0.6)}};
}

/// A cube with its edges cut off at 45 degrees.
TriMesh chamfered_cube(double width) {
  const double low = width, high = 1 - width;
  geom::MeshArrays arrays;
  std::map<std::array<double, 3>, VertexId> ids;
  const auto corner = [&](int axis, int x, int y, int z) {
    const std::array<int, 3> s{x, y, z};
    std::array<double, 3> p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = static_cast<int>(a) == axis ? s[a] : s[a] ? high : low;
    const auto [at, is_new] = ids.try_emplace(p);
    if (is_new) at->second = arrays.add({p[0], p[1], p[2]});
    return at->second;
  };
  const auto add = [&](std::vector<VertexId> polygon) {  // turned so that the middle of the cube is behind it
    const Vec3 a = arrays.vertices[polygon[0]], b = arrays.vertices[polygon[1]],
               c = arrays.vertices[polygon[2]];
    if ((b - a).cross(c - a).dot(a - Vec3::Constant(0.5)) < 0) std::ranges::reverse(polygon);
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      arrays.add_triangle(polygon[0], polygon[k], polygon[k + 1]);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int s : {0, 1}) {
      const auto at = [&](int i, int j) {
        std::array<int, 3> p{};
        p[static_cast<std::size_t>(axis)] = s;
        p[static_cast<std::size_t>((axis + 1) % 3)] = i;
        p[static_cast<std::size_t>((axis + 2) % 3)] = j;
        return corner(axis, p[0], p[1], p[2]);
      };
      add({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
      for (const int t : {0, 1}) {  // the chamfer between this side and one across the next axis
        const auto edge = [&](int of, int k) {
          std::array<int, 3> p{};
          p[static_cast<std::size_t>(axis)] = s;
          p[static_cast<std::size_t>((axis + 1) % 3)] = t;
          p[static_cast<std::size_t>((axis + 2) % 3)] = k;
          return corner(of, p[0], p[1], p[2]);
        };
        const int next = (axis + 1) % 3;
        add({edge(axis, 0), edge(axis, 1), edge(next, 1), edge(next, 0)});
      }
    }
  for (int i = 0; i < 8; ++i)
    add({corner(0, i & 1, i >> 1 & 1, i >> 2), corner(1, i & 1, i >> 1 & 1, i >> 2),
         corner(2, i & 1, i >> 1 & 1, i >> 2)});
  return arrays.take();
}

}  // namespace

TEST_CASE("feature choice: machined shapes keep the curves that they have") {
  struct Expected {
    const char* name;
    std::size_t corners, curves;
  };
  for (const Expected& shape : {Expected{"wedge", 6, 9},
                                {"star", 20, 30},
                                {"gear", 128, 194},
                                {"hole-plate", 8, 36},
                                {"shaft", 0, 4},
                                {"cone-plate", 0, 3},
                                {"two-cylinders", 0, 4}}) {
    CAPTURE(shape.name);
    const TriMesh mesh = geom::make_shape(shape.name);
    const Features features = automatic(mesh, 4000);
    CHECK(features.corners.size() == shape.corners);
    CHECK(features.curves.size() == shape.curves);
  }
  // The crest of the thread and both its feet are open, but long.
  CHECK(automatic(geom::make_shape("screw"), 4000).curves.size() >= 3);
}

TEST_CASE("feature choice: no creases in noise") {
  for (const double share : {0.001, 0.01}) {
    CAPTURE(share);
    for (const char* name : {"sphere", "torus"}) {
      CAPTURE(name);
      const TriMesh mesh = noisy(geom::make_shape(name, name[0] == 's' ? 24 : 60), share);
      for (const std::size_t n : {500, 4000}) CHECK(automatic(mesh, n).curves.empty());
    }
  }
}

TEST_CASE("feature choice: plane faces whose edges meet by fours are no disorder, bent ones are") {
  const TriMesh cube = chamfered_cube(0.1);
  TriMesh cubes = cube;
  for (int i = 1; i < 3; ++i)
    cubes = geom::joined(
        cubes, geom::mapped(cube, [i](const Vec3& p) -> Vec3 { return p + 2 * i * Vec3::UnitX(); }));
  CHECK(choose_features(cubes, automatic_features(), plan_of(cubes, 3000)).features.curves.size() == 3 * 48);
  const FeatureChoice bent = choose_features(noisy(cubes, 0.01), automatic_features(), plan_of(cubes, 3000));
  CHECK(bent.features.curves.empty());
  CHECK(!bent.given_up.empty());
}

TEST_CASE("feature choice: plane faces beside a finer mesh are no disorder") {
  TriMesh cubes = geom::make_shape("square", 100);  // flat, and nearly all edges are its own
  for (int i = 1; i < 4; ++i)
    cubes = geom::joined(cubes, geom::mapped(chamfered_cube(0.1), [i](const Vec3& p) -> Vec3 {
                           return p + 2 * i * Vec3::UnitX();
                         }));
  CHECK(choose_features(cubes, automatic_features(), plan_of(cubes, 3000)).features.curves.size() ==
        4 + 3 * 48);
}

TEST_CASE("feature choice: edges that a lattice cut off in steps are no creases") {
  const geom::ImplicitSurface cup = cup_surface();
  for (const int cells : {30, 35, 50, 60}) {
    CAPTURE(cells);
    const TriMesh mesh = geom::polygonised(cup, cells);
    REQUIRE(geom::topology(mesh).euler == 2);
    for (const std::size_t n : {500, 2000}) CHECK(automatic(mesh, n).curves.empty());
  }
}

TEST_CASE("feature choice: what nobody asked for is never refused, and what is given up is said") {
  const TriMesh cube = geom::make_shape("cube");
  for (const std::size_t n : {1, 4, 7, 9, 15}) {
    const FeatureChoice choice = choose_features(cube, automatic_features(), plan_of(cube, n));
    CHECK(choice.features.empty());
    CHECK(!choice.given_up.empty());
    CHECK(choice.are_missed);
  }
  CHECK(!choose_features(cube, automatic_features(), plan_of(cube, 16)).are_missed);
  CHECK(choose_features(cube, automatic_features(), plan_of(cube, 16)).features.corners.size() == 8);
  CHECK(choose_features(cube, {}, plan_of(cube, 4)).features.corners.size() == 8);  // asked for
  const TriMesh square = geom::make_shape("square", 3);
  const FeatureChoice three = choose_features(square, automatic_features(), plan_of(square, 3));
  CHECK(three.features.corners.empty());
  CHECK(three.features.curves.size() == 1);
  CHECK(!three.given_up.empty());
  CHECK(three.are_missed);
}

TEST_CASE("feature choice: lines that somebody asked for are not among those given up") {
  const TriMesh gear = geom::make_shape("gear");
  SamplingPlan plan = plan_of(gear, 300);
  plan.strong_only = true;
  FeatureOptions options = automatic_features();
  const auto edges_of = [](const Features& features) {
    std::set<std::pair<VertexId, VertexId>> edges;
    std::vector<std::size_t> all(features.curves.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const auto& [a, b] : edges_of_curves(features, all)) edges.insert(std::minmax(a, b));
    return edges;
  };
  const auto all = edges_of(find_features(gear, options));
  const auto kept = edges_of(choose_features(gear, options, plan).features);
  for (const auto& edge : all)
    if (!kept.contains(edge) && options.marked.empty()) options.marked.push_back({edge.first, edge.second});
  REQUIRE(!options.marked.empty());
  const FeatureChoice now = choose_features(gear, options, plan);
  CHECK(!now.given_up.empty());
  const auto [a, b] = options.marked.front();
  CHECK(edges_of(now.features).contains(std::minmax(a, b)));
}

TEST_CASE("feature choice: slivers make no creases and break none") {
  const TriMesh cube = geom::make_shape("cube", 3);
  // Vertices next to others, on edges: needles whose normals are rounding only.
  geom::MeshArrays arrays{cube.vertices(), cube.facets()};
  for (int k = 0; k < 12; ++k) {
    const FacetId t(7 * k % arrays.facets.size());
    const TriMesh::Facet f = arrays.facets[t];
    const VertexId m =
        arrays.add(arrays.vertices[f[0]] + 1e-10 * (arrays.vertices[f[1]] - arrays.vertices[f[0]]) +
                   Vec3(3e-11, 1e-11, 2e-11));
    const std::size_t count = arrays.facets.size();
    for (std::size_t s = 0; s < count; ++s)
      for (std::size_t e = 0; e < 3; ++e) {
        const TriMesh::Facet g = arrays.facets[FacetId(s)];
        const VertexId a = g[e], b = g[(e + 1) % 3], c = g[(e + 2) % 3];
        if (!((a == f[0] && b == f[1]) || (a == f[1] && b == f[0]))) continue;
        arrays.facets[FacetId(s)] = {a, m, c};
        arrays.add_triangle(m, b, c);
        break;
      }
  }
  const TriMesh spoilt = arrays.take();
  REQUIRE(geom::topology(spoilt).manifold());
  const Features features = automatic(spoilt, 400);
  CHECK(features.corners.size() == 8);
  CHECK(features.curves.size() == 12);
}

TEST_CASE("feature choice: short curves collapse, but not at the ends of strips") {
  const TriMesh cube = geom::make_shape("cube", 4);
  const TriMesh frustum = geom::mapped(cube, [](const Vec3& p) -> Vec3 {
    const double side = 1 - 0.99 * p.z();
    return {side * (p.x() - 0.5), side * (p.y() - 0.5), p.z()};
  });
  const Features all = find_features(frustum);
  REQUIRE(all.corners.size() == 8);
  REQUIRE(all.curves.size() == 12);
  const Features few = with_short_curves_collapsed(frustum, all, 0.05);
  CHECK(few.corners.size() == 5);
  CHECK(few.curves.size() == 8);
  for (const FeatureCurve& curve : few.curves) {
    CHECK(curve.facets.size() + 1 == curve.vertices.size());
    for (std::size_t i = 0; i < curve.facets.size(); ++i) {
      const TriMesh::Facet& f = frustum.facet(curve.facets[i]);
      CHECK(std::ranges::count(f, curve.vertices[i]) + std::ranges::count(f, curve.vertices[i + 1]) == 2);
    }
    for (const VertexId end : {curve.vertices.front(), curve.vertices.back()})
      CHECK(std::ranges::binary_search(few.corners, end));
  }
  CHECK(with_short_curves_collapsed(frustum, all, 0.005).curves.size() == 12);

  const TriMesh chamfered = chamfered_cube(0.01), plate = geom::make_shape("thin-plate");
  REQUIRE(geom::topology(chamfered).euler == 2);
  CHECK(with_short_curves_collapsed(chamfered, find_features(chamfered), 0.05).curves.size() == 48);
  CHECK(with_short_curves_collapsed(plate, find_features(plate), 0.05).curves.size() == 12);
}
