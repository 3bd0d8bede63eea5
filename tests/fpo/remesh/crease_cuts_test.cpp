#include "fpo/remesh/crease_cuts.h"

#include <cmath>
#include <vector>

#include "doctest.h"
#include "tests/fixtures/blade.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/triangles.h"

using namespace fpo;
using fixtures::Blade;
using geom::TriMesh;
using geom::Vec3;

namespace {

std::vector<EdgeCut> cuts_of(const TriMesh& surface, const std::vector<fixtures::Triangle>& remesh,
                             double spacing = 1) {
  const TriMesh mesh = fixtures::apart(remesh);
  return crease_cuts(surface, find_features(surface), {mesh, mesh.num_vertices()}, spacing);
}

Vec3 place(const TriMesh& surface, const EdgeCut& cut) {
  const Vec3 &a = surface.position(cut.edge[0]), &b = surface.position(cut.edge[1]);
  return a + cut.share * (b - a);
}

}  // namespace

TEST_CASE("crease cuts: on both edges of a corner, where they are far enough from each other") {
  const Blade blade(1);
  for (const double spacing : {0.3, 1.0}) {
    const std::vector<EdgeCut> cuts = cuts_of(blade.mesh, {blade.tip()}, spacing);
    REQUIRE(cuts.size() == 2);
    CHECK(cuts[0].edge != cuts[1].edge);
    const double far = 0.7 * spacing / std::sin(blade.angle);
    for (const EdgeCut& cut : cuts) {
      const Vec3 at = place(blade.mesh, cut);
      CHECK(at.z() == 0);
      CHECK(at.norm() >= far);
      CHECK(at.norm() < far + 0.051 * spacing);
    }
  }
}

TEST_CASE("crease cuts: none where edges are short, or nowhere far enough, or angles are fair") {
  CHECK(cuts_of(Blade(24).mesh, {Blade::tip()}).empty());
  CHECK(cuts_of(Blade(1).mesh, {Blade::tip()}, 10).empty());
  const TriMesh plate = fixtures::block(10, 4, 0.3);
  CHECK(cuts_of(plate, {{Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(2, 0, 0.3)}}).empty());
  const TriMesh cube = fixtures::block(10, 10, 10);
  CHECK(cuts_of(cube, {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}}).empty());
  CHECK(cuts_of(cube, {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.1, 0)}}).size() == 3);  // one is to blame
}

TEST_CASE("crease cuts: to both sides of a place within an edge") {
  // The ridge of one roof comes down to the edge of a long block: a fault where the ridge is near.
  geom::MeshArrays arrays;
  const auto a = arrays.add({-10, 0, 0}), b = arrays.add({10, 0, 0}), c = arrays.add({0, 10, 0}),
             d = arrays.add({0, 5, -8}), e = arrays.add({0, 0.3, 0});
  arrays.add_triangle(a, b, e);
  arrays.add_triangle(b, c, e);
  arrays.add_triangle(c, a, e);
  arrays.add_triangle(b, a, d);
  arrays.add_triangle(c, b, d);
  arrays.add_triangle(a, c, d);
  const TriMesh mesh = arrays.take();
  FeatureOptions options;
  options.marked = {{c, e}};
  const Features features = find_features(mesh, options);
  const TriMesh remesh = fixtures::apart({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.3, 0)}});
  const std::vector<EdgeCut> cuts = crease_cuts(mesh, features, {remesh, 3}, 1);
  const double half = std::sqrt(0.7 * 0.7 - 0.3 * 0.3);
  std::vector<double> at;
  for (const EdgeCut& cut : cuts)
    if (place(mesh, cut).y() == 0) at.push_back(place(mesh, cut).x());
  REQUIRE(at.size() == 2);
  for (const double x : at) {
    CHECK(std::abs(x) >= half);
    CHECK(std::abs(x) < half + 0.051);
  }
  CHECK(at[0] * at[1] < 0);
}
