#include "fpo/surface/local_feature_size.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../fixtures/parametric.h"
#include "../../fixtures/surfaces.h"
#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"

using fpo::local_feature_size;
using fpo::medial_points;
using fpo::MedialPoint;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TriMesh local_feature_size_mapped(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& map) {
  Table<VertexId, Vec3> vertices = mesh.vertices();
  for (Vec3& v : vertices) v = map(v);
  return TriMesh(std::move(vertices), mesh.facets());
}

TriMesh of_both(const TriMesh& a, const TriMesh& b) {
  Table<VertexId, Vec3> vertices = a.vertices();
  Table<geom::FacetId, TriMesh::Facet> facets = a.facets();
  const auto base = static_cast<std::int32_t>(a.num_vertices());
  for (const Vec3& v : b.vertices()) vertices.push_back(v);
  for (const TriMesh::Facet& f : b.facets())
    facets.push_back({VertexId(f[0].value + base), VertexId(f[1].value + base), VertexId(f[2].value + base)});
  return TriMesh(std::move(vertices), std::move(facets));
}

struct Range {
  double low, high;
};

Range range(const Table<VertexId, double>& size) {
  return {*std::ranges::min_element(size), *std::ranges::max_element(size)};
}

std::vector<Vec3> random_locations(const TriMesh& mesh, std::size_t n) {
  std::vector<Vec3> locations;
  for (const fpo::SurfaceSample& s : fpo::random_samples(mesh, n, 9)) locations.push_back(s.position);
  return locations;
}

/// Share of values that differ by more than `tolerance`.
double share_off(std::span<const double> a, std::span<const double> b, double tolerance) {
  REQUIRE(a.size() == b.size());
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off += !(std::abs(a[i] - b[i]) <= tolerance);
  return static_cast<double>(off) / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("local feature size: the radius on a sphere, coarse or dense") {
  for (const int size : {2, 3, 10, 40}) {
    for (const double spacing : {0.0, 0.3, 0.05}) {
      CAPTURE(size);
      CAPTURE(spacing);
      const auto [low, high] =
          range(local_feature_size(geom::make_shape("sphere", size), {.spacing = spacing}));
      CHECK(low > (size == 2 ? 0.8 : 0.93));  // facets of size 2 are 0.1 inside
      CHECK(high < 1.05);
    }
  }
}

TEST_CASE("local feature size: the circle inside a torus and the axis in its hole") {
  for (const double tube : {0.4, 0.7}) {
    for (const double jitter : {0.0, 0.3}) {
      const TriMesh mesh = fixtures::torus(1, tube, {72, 40, true, true, jitter});
      const auto size = local_feature_size(mesh, {.spacing = 0.06});
      double worst = 0;
      for (VertexId v(0); v.index() < size.size(); v = VertexId(v.value + 1))
        worst = std::max(worst, std::abs(size[v] - std::min(tube, mesh.position(v).head<2>().norm())));
      CAPTURE(tube);
      CAPTURE(jitter);
      CHECK(worst < 0.06 * tube);
    }
  }
}

TEST_CASE("local feature size: a tube thinner than the poles that are trusted") {
  for (const double spacing : {0.05, 0.08, 0.1, 0.12}) {
    const TriMesh mesh = fixtures::torus(1, 0.1, {90, 12, true, true, 0.2});
    const auto [low, high] = range(local_feature_size(mesh, {.spacing = spacing}));
    CAPTURE(spacing);
    CHECK(low > 0.06);
    CHECK(high < 0.15);
  }
}

TEST_CASE("local feature size: half the distance of two plates, whatever their orientation") {
  Table<VertexId, Vec3> v;
  Table<geom::FacetId, TriMesh::Facet> f;
  fixtures::add_grid(v, f, 2, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.1, 1, 0));
  const TriMesh plate(v, f);
  for (const double distance : {0.05, 0.1, 0.2}) {
    const TriMesh both = of_both(plate, local_feature_size_mapped(plate, [=](const Vec3& x) {
                                   return Vec3(x + Vec3(0, 0, distance));
                                 }));
    const auto locations = random_locations(both, 300);
    const auto medial = medial_points(both, {.spacing = 0.02});
    const std::vector<double> size = local_feature_size(locations, medial);
    double smallest = infinity, largest_inside = 0;
    for (std::size_t i = 0; i < size.size(); ++i) {
      smallest = std::min(smallest, size[i]);
      if ((locations[i].head<2>() - geom::Vec2(0.55, 0.5)).lpNorm<Eigen::Infinity>() < 0.3)
        largest_inside = std::max(largest_inside, size[i]);
    }
    CAPTURE(distance);
    CHECK(smallest > distance / 2 - 0.01);
    CHECK(largest_inside < distance / 2 + 0.01);
  }
  // Sheets nearer than 3 spacings, facing away from each other as in a body.
  const TriMesh thin = fixtures::box(Vec3(1, 1, 0.03), 1);
  const auto of_thin =
      local_feature_size(random_locations(thin, 300), medial_points(thin, {.spacing = 0.02}));
  CHECK(*std::ranges::max_element(of_thin) < 0.03);
}

TEST_CASE("local feature size: on a cube, to the planes that halve its edges") {
  const double spacing = 0.025;
  for (const TriMesh& cube : {geom::make_shape("cube", 1), geom::tilted(geom::make_shape("cube", 3))}) {
    const auto medial = medial_points(cube, {.spacing = spacing});
    const std::vector<Vec3> locations = random_locations(cube, 500);
    const std::vector<double> size = local_feature_size(locations, medial);
    double too_large = 0, too_small = 0;
    for (std::size_t i = 0; i < size.size(); ++i) {
      double to_edge = infinity;  // the least distance to the plane of another side
      for (geom::FacetId t(0); t.index() < cube.num_facets(); t = geom::FacetId(t.value + 1)) {
        const double to_plane = std::abs(cube.normal(t).normalized().dot(locations[i] - cube.corner(t, 0)));
        if (to_plane > 1e-9) to_edge = std::min(to_edge, to_plane);
      }
      const double expected = to_edge / std::sqrt(2);
      too_large = std::max(too_large, size[i] - std::max(expected, 2 * spacing));
      too_small = std::max(too_small, expected - size[i]);
    }
    CHECK(too_large < spacing);
    CHECK(too_small < spacing);
  }
}

TEST_CASE("local feature size: medial points are as far from the surface as their balls say") {
  for (const char* name : {"blob", "joint", "l-block", "double-torus", "moebius", "wave-disk"}) {
    const TriMesh mesh = geom::make_shape(name);
    const double spacing = 0.03 * std::sqrt(mesh.area());
    const geom::AabbTree tree(mesh);
    const auto medial = medial_points(mesh, {.spacing = spacing});
    CAPTURE(name);
    CHECK(medial.size() > 10);
    double too_far = 0, too_near = 0;
    for (const MedialPoint& m : medial) {
      const double distance = std::sqrt(tree.closest(m.position).distance2);
      too_far = std::max(too_far, distance - m.radius);
      too_near = std::max(too_near, m.radius - distance);
    }
    CHECK(too_far < 1e-6 * mesh.diagonal());
    CHECK(too_near < spacing);
  }
}

TEST_CASE("local feature size: 1-Lipschitz, and the same on every call, by any number of threads") {
  const TriMesh mesh = geom::make_shape("blob", 8, 3);
  const fpo::LocalFeatureSizeOptions options{.spacing = 0.1};
  const auto size = local_feature_size(mesh, options);
  CHECK(size == local_feature_size(mesh, options));
  CHECK(size == local_feature_size(mesh, {.spacing = 0.1, .threads = 3}));
  double steepest = 0;
  for (VertexId v(0); v.index() < size.size(); v = VertexId(v.value + 1))
    for (VertexId u(0); u < v; u = VertexId(u.value + 1))
      steepest =
          std::max(steepest, std::abs(size[v] - size[u]) / (mesh.position(v) - mesh.position(u)).norm());
  CHECK(steepest <= 1 + 1e-9);
}

TEST_CASE("local feature size: moves and scales with the surface, whatever the order of its vertices") {
  const TriMesh mesh = geom::make_shape("blob", 12, 3);
  const double spacing = 0.06;
  const auto size = local_feature_size(mesh, {.spacing = spacing});
  const auto larger =
      local_feature_size(local_feature_size_mapped(mesh, [](const Vec3& x) { return Vec3(x * 0x1p20); }),
                         {.spacing = spacing * 0x1p20});
  bool exact = true;
  for (VertexId v(0); v.index() < size.size(); v = VertexId(v.value + 1))
    exact &= larger[v] == size[v] * 0x1p20;
  CHECK(exact);

  const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, 3).normalized());
  auto turned = local_feature_size(
      local_feature_size_mapped(mesh, [&](const Vec3& x) { return Vec3(turn * x * 3.7 + Vec3(5, 6, 7)); }),
      {.spacing = spacing * 3.7});
  for (double& s : turned) s /= 3.7;
  CHECK(share_off({size.data(), size.size()}, {turned.data(), turned.size()}, spacing) < 0.01);

  std::vector<VertexId> new_id;
  const auto shuffled = local_feature_size(fixtures::reordered(mesh, new_id), {.spacing = spacing});
  std::vector<double> in_order;
  for (const VertexId v : new_id) in_order.push_back(shuffled[v]);
  CHECK(share_off({size.data(), size.size()}, in_order, spacing) < 0.01);

  const auto other_seed = local_feature_size(mesh, {.spacing = spacing, .seed = 8});
  CHECK(share_off({size.data(), size.size()}, {other_seed.data(), other_seed.size()}, spacing) < 0.01);
}

TEST_CASE("local feature size: does not collapse on a dense noisy sphere") {
  const TriMesh smooth = geom::make_shape("sphere", 40);  // edges of about 0.03
  geom::Rng rng(11);
  for (const double noise : {0.002, 0.005, 0.01}) {
    const TriMesh mesh = local_feature_size_mapped(
        smooth, [&](const Vec3& x) { return Vec3(x * (1 + rng.uniform(-noise, noise))); });
    const auto [low, high] = range(local_feature_size(mesh, {.spacing = 0.1}));
    CAPTURE(noise);
    CHECK(low > 0.85);
    CHECK(high < 1.1);
  }
}

TEST_CASE("local feature size: infinite where there is no medial axis") {
  const auto all_infinite = [](const TriMesh& mesh, double spacing) {
    return std::ranges::all_of(local_feature_size(mesh, {.spacing = spacing}),
                               [](double s) { return s == infinity; });
  };
  for (const double spacing : {0.0, 0.02, 10.0}) {
    CAPTURE(spacing);
    CHECK(all_infinite(geom::make_shape("square", 9), spacing));
    CHECK(all_infinite(geom::tilted(geom::make_shape("square", 9)), spacing));
    CHECK(all_infinite(geom::make_shape("triangle", 1), spacing));
    CHECK(all_infinite(fixtures::tilted_square(20), spacing));
  }
  CHECK(local_feature_size(TriMesh(), {.spacing = 0.1}).empty());
  const TriMesh lonely({Vec3(1, 2, 3), Vec3(1, 2, 3)}, {});
  CHECK(local_feature_size(lonely, {}).size() == 2);
  CHECK(all_infinite(lonely, 0.1));
}

TEST_CASE("local feature size: duplicated and unused vertices, border, facets without area") {
  const TriMesh sphere = geom::make_shape("sphere", 6);
  // A soup: every facet has vertices of its own; one vertex more, of no facet; one facet without area.
  Table<VertexId, Vec3> vertices;
  Table<geom::FacetId, TriMesh::Facet> facets;
  for (geom::FacetId t(0); t.index() < sphere.num_facets(); t = geom::FacetId(t.value + 1)) {
    const auto base = static_cast<std::int32_t>(vertices.size());
    for (int i = 0; i < 3; ++i) vertices.push_back(sphere.corner(t, i));
    facets.push_back({VertexId(base), VertexId(base + 1), VertexId(base + 2)});
  }
  facets.push_back({VertexId(0), VertexId(3), VertexId(6)});
  vertices.push_back(Vec3(0, 0, 50));
  for (const double spacing : {0.0, 0.1}) {
    const auto size = local_feature_size(TriMesh(vertices, facets), {.spacing = spacing});
    CHECK(size[VertexId(vertices.size() - 1)] == doctest::Approx(50).epsilon(0.01));
    CHECK(*std::ranges::min_element(size) > 0.9);
    CHECK(*std::max_element(size.begin(), size.end() - 1) < 1.05);
  }
  const TriMesh bowl = fixtures::parametric({20, 60, false, true, 0.2}, [](double u, double v) {
    const double a = 0.05 + 1.45 * u, b = 2 * std::numbers::pi * v;
    return Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), -std::cos(a));
  });
  const auto [low, high] = range(local_feature_size(bowl, {.spacing = 0.06}));
  CHECK(low > 0.9);
  CHECK(high < 1.1);
}

TEST_CASE("local feature size: options out of range are refused") {
  const TriMesh mesh = geom::make_shape("sphere", 2);
  CHECK_THROWS_AS(local_feature_size(mesh, {.spacing = -1}), geom::InputError);
  CHECK_THROWS_AS(local_feature_size(mesh, {.min_radius = infinity}), geom::InputError);
  CHECK_THROWS_AS(local_feature_size(mesh, {.min_angle = 180}), geom::InputError);
  CHECK_THROWS_AS(local_feature_size(mesh, {.min_angle_within_facets = std::nan("")}), geom::InputError);
}
