#include "geom/mesh/facet_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "doctest.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/power/facet_cells.h"
#include "geom/rng.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/levels.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

namespace {

double distance2(const TriMesh& mesh, FacetId t, const Vec3& x) {
  return closest_point(x, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}).distance2;
}

std::vector<FacetId> near(const FacetTree& tree, const Vec3& x, double distance) {
  std::vector<FacetId> found;
  tree.near(x, distance, found);
  std::ranges::sort(found);
  return found;
}

/// All facets that come within the distance are found, each once; `slack`: of rounded distances.
void check_near(const TriMesh& mesh, const FacetTree& tree, const Vec3& x, double distance) {
  const std::vector<FacetId> found = near(tree, x, distance);
  CHECK(std::ranges::adjacent_find(found) == found.end());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    if (std::sqrt(distance2(mesh, t, x)) <= distance)
      REQUIRE_MESSAGE(std::ranges::binary_search(found, t), "facet " << t.value);
}

}  // namespace

TEST_CASE(
    "facet tree: all facets within a distance of any place are found, in whatever order they are kept") {
  Rng rng(6);
  std::vector<fixtures::NamedSurface> all = fixtures::hard_surfaces();
  for (fixtures::NamedSurface& s : fixtures::surfaces()) all.push_back(std::move(s));
  for (const auto& surface : all) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    std::vector<FacetId> order = facets_along_curve(mesh);
    const FacetTree along(mesh, order);
    rng.shuffle(std::span(order));
    const FacetTree shuffled(mesh, order);
    for (int query = 0; query < 60; ++query) {
      const FacetId t(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      Vec3 x = mesh.corner(t, static_cast<int>(rng.below(3)));
      if (query % 3 == 1) x += mesh.diagonal() * 0.3 * fixtures::random_vector(rng);
      if (query % 3 == 2) x = (x + mesh.corner(t, 0) + mesh.corner(t, 1)) / 3;
      // Also just as far as a facet is, to the bit.
      const FacetId other(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      const double touching = std::sqrt(distance2(mesh, other, x));
      for (const double distance : {0.0, touching, mesh.diagonal() * std::pow(10, rng.uniform(-8, 1))})
        for (const FacetTree* const tree : {&along, &shuffled}) check_near(mesh, *tree, x, distance);
    }
  }
}

// A facet is in four dimensions then, and so is its distance.
TEST_CASE("facet tree: where there are levels they count, and what is on another one is left out") {
  Rng rng(11);
  for (const fixtures::Levels kind : fixtures::all_levels) {
    CAPTURE(static_cast<int>(kind));
    const TriMesh mesh = fixtures::with_levels(fixtures::blob(10), kind, 0.7);
    const FacetTree tree(mesh, facets_along_curve(mesh)),
        flat(mesh.with_levels({}), facets_along_curve(mesh));
    std::size_t left_out = 0;
    for (int query = 0; query < 2000; ++query) {
      const FacetId t(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      const double a = rng.uniform(), b = (1 - a) * rng.uniform(), c = 1 - a - b;
      const auto [u, v, w] = mesh.facet(t);
      const Vec3 z = a * mesh.position(u) + b * mesh.position(v) + c * mesh.position(w);
      const double height = a * mesh.level(u) + b * mesh.level(v) + c * mesh.level(w);
      const Vec3 x = z + 0.2 * fixtures::random_vector(rng);
      const double level = height + rng.uniform(-0.2, 0.2);
      const double distance = std::sqrt((x - z).squaredNorm() + (level - height) * (level - height));
      std::vector<FacetId> found, in_space;
      tree.near({x, level}, distance * (1 + 1e-12), found);
      CHECK(std::ranges::find(found, t) != found.end());
      flat.near(x, distance, in_space);
      left_out += in_space.size() > found.size();
    }
    CHECK(left_out > 300);
  }
}

// Not all of them every time.
TEST_CASE("facet tree: few others are found") {
  const TriMesh blob = fixtures::blob(30);
  const FacetTree tree(blob, facets_along_curve(blob));
  Rng rng(3);
  for (int query = 0; query < 300; ++query) {
    const FacetId t(static_cast<std::size_t>(rng.below(blob.num_facets())));
    const double distance = 0.3 * rng.uniform();
    const std::vector<FacetId> found = near(tree, blob.corner(t, 0), distance);
    std::size_t within = 0;
    for (FacetId f(0); f.index() < blob.num_facets(); f = FacetId(f.value + 1))
      within += std::sqrt(distance2(blob, f, blob.corner(t, 0))) <= distance + 0.15;
    CHECK(found.size() <= within);
  }
  CHECK(near(tree, Vec3(9, 9, 9), 1).empty());
  CHECK(near(tree, Vec3(9, 9, 9), 100).size() == blob.num_facets());
}

TEST_CASE("facet tree: coordinates between those of single precision, and of any size") {
  Rng rng(7);
  for (const double size : {1e-300, 1e-50, 1e-30, 1e-20, 1.0, 1e15, 1e30, 1e60}) {
    CAPTURE(size);
    Table<VertexId, Vec3> vertices;
    Table<FacetId, TriMesh::Facet> facets;
    for (int i = 0; i < 40; ++i) {
      const Vec3 at = fixtures::random_vector(rng);
      for (int k = 0; k < 3; ++k) vertices.push_back(size * (at + 1e-9 * fixtures::random_vector(rng)));
      facets.push_back({VertexId(3 * i), VertexId(3 * i + 1), VertexId(3 * i + 2)});
    }
    const TriMesh mesh(std::move(vertices), std::move(facets));
    const FacetTree tree(mesh, facets_along_curve(mesh));
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      for (int i = 0; i < 3; ++i) {
        const std::vector<FacetId> found = near(tree, mesh.corner(t, i), 0);
        CHECK(std::ranges::binary_search(found, t));
        check_near(mesh, tree, mesh.corner(t, i), size * rng.uniform(0, 2));
      }
  }
}

TEST_CASE("facet tree: no facet is within a negative distance, or one that is no number") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 2);
  const FacetTree tree(cube, facets_along_curve(cube));
  CHECK(near(tree, Vec3(0, 0, 0), -1).empty());
  CHECK(near(tree, Vec3(0, 0, 0), -std::numeric_limits<double>::infinity()).empty());
  CHECK(near(tree, Vec3(0, 0, 0), std::numeric_limits<double>::quiet_NaN()).empty());
  CHECK(near(tree, Vec3(0, 0, 0), std::numeric_limits<double>::infinity()).size() == cube.num_facets());
  const TriMesh one({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{VertexId(0), VertexId(1), VertexId(2)}});
  const FacetTree of_one(one, {FacetId(0)});
  CHECK(near(of_one, Vec3(0, 0, 2), 2).size() == 1);
  CHECK(near(of_one, Vec3(0, 0, 2), 1.9).empty());
}

TEST_CASE("facet tree: only facets in balls that are of no use are left out") {
  Rng rng(8);
  std::size_t left_out = 0;
  for (const auto& surface : fixtures::hard_surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const FacetTree tree(mesh, facets_along_curve(mesh));
    for (int query = 0; query < 20; ++query) {
      const FacetId t(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      const Vec3 x = mesh.corner(t, 0), normal = fixtures::random_vector(rng).normalized();
      const double distance = mesh.diagonal() * std::pow(10, rng.uniform(-2, 0));
      const auto height = [&](const Vec3& z) { return normal.dot(z - x); };
      std::vector<FacetId> found;
      tree.near_but(
          x, distance, [&](const Location3& z, double radius) { return height(z.position) > radius; }, found);
      std::ranges::sort(found);
      CHECK(std::ranges::adjacent_find(found) == found.end());
      std::size_t above = 0;
      for (const FacetId f : near(tree, x, distance)) {
        bool is_above = true;
        for (int i = 0; i < 3; ++i) is_above &= height(mesh.corner(f, i)) > 0;
        above += is_above;
        if (!is_above) CHECK(std::ranges::binary_search(found, f));
      }
      CHECK(found.size() + above >= near(tree, x, distance).size());
      left_out += near(tree, x, distance).size() - found.size();
    }
  }
  CHECK(left_out > 1000);
}
