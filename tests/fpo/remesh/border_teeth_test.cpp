#include "fpo/remesh/border_teeth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "doctest.h"
#include "geom/mesh/angles.h"
#include "geom/mesh/submesh.h"
#include "geom/mesh/surface_type.h"
#include "geom/rng.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sawtooth.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<geom::PartType> sorted_parts(const geom::SurfaceType& type) {
  std::vector<geom::PartType> parts = type.parts;
  std::ranges::sort(parts);
  return parts;
}

std::size_t number_left(const TriMesh& mesh, const Tooth& tooth) { return without_teeth(mesh, tooth).size(); }

/// Points between two legs of length 20 that meet at such an angle, and at none of less than 75 degrees else.
TriMesh wedge(double angle) {
  geom::Table<VertexId, Vec3> corners;
  for (const double a : {-angle / 2, angle / 2}) corners.push_back(20 * Vec3(std::cos(a), std::sin(a), 0));
  corners.push_back(Vec3(0, 0, 0));
  corners.push_back(Vec3(24, 0, 0));
  geom::Table<FacetId, TriMesh::Facet> facets;
  facets.push_back({VertexId(2), VertexId(0), VertexId(1)});
  facets.push_back({VertexId(0), VertexId(3), VertexId(1)});
  return geom::subdivided({std::move(corners), std::move(facets)}, 40);
}

/// A grid, bent, of which each facet is missing with that probability near its middle line.
TriMesh torn(std::uint64_t seed, double share) {
  const TriMesh whole = geom::mapped(geom::make_shape("square", 24), [](const Vec3& p) -> Vec3 {
    return {p[0], p[1], 0.3 * std::sin(3 * p[0])};
  });
  geom::Rng rng(seed);
  std::vector<FacetId> facets;
  const Vec3 middle = whole.box().center();
  for (FacetId t(0); t.index() < whole.num_facets(); t = FacetId(t.value + 1)) {
    const double x = (whole.corner(t, 0)[0] + whole.corner(t, 1)[0] + whole.corner(t, 2)[0]) / 3 - middle[0];
    const double size = whole.box().sizes()[0];
    if (x > 0.2 * size || (x > -0.1 * size && rng.uniform() < share)) continue;
    facets.push_back(t);
  }
  return geom::submesh(whole, std::move(facets)).mesh;
}

}  // namespace

TEST_CASE("border teeth: facets that stand out are cut off, nothing else is") {
  for (const double height : {1.5, 2.5}) {
    const TriMesh plate = fixtures::sawtooth_plate(20, height);
    const std::vector<FacetId> left = without_teeth(plate, {3, 75 * degree});
    REQUIRE(left.size() == 800);
    CHECK(left.back() == FacetId(799));
    // Not those that are longer, or blunter.
    CHECK(number_left(plate, {height, 75 * degree}) == plate.num_facets());
    const double tip = 2 * std::atan(0.5 / height);
    CHECK(number_left(plate, {3, tip - 0.01}) == plate.num_facets());
    CHECK(number_left(plate, {3, tip + 0.01}) == 800);
  }
  const TriMesh closed = geom::make_shape("sphere", 8);
  CHECK(number_left(closed, {1, 1}) == closed.num_facets());
}

TEST_CASE("border teeth: corners of the surface stay, however fine facets are") {
  for (const double angle : {20 * degree, 45 * degree, 70 * degree}) {
    const TriMesh fine = wedge(angle);
    for (const double longest : {0.6, 1.0, 2.5})
      CHECK(number_left(fine, {longest, 75 * degree}) == fine.num_facets());
  }
  // Small parts do, too: crumbs are not teeth.
  const TriMesh crumb = fixtures::sawtooth_plate(4, 1.5);
  CHECK(number_left(crumb, {3, 75 * degree}) == crumb.num_facets());
}

TEST_CASE("border teeth: what is a corner from nearby only is a tooth") {
  // One tooth, between a notch six deep and a step three squares away: from four away the border turns by 108
  // degrees there, from eight by 80.
  const TriMesh plate = fixtures::sawtooth_plate(20, 1.5);
  std::vector<FacetId> facets;
  for (int t = 0; t < 800; ++t) {
    const int x = t / 2 % 20, y = t / 40;
    if (!(x >= 8 && x < 11 && y >= 14) && !(x < 4 && y == 19)) facets.emplace_back(t);
  }
  facets.emplace_back(803);
  const TriMesh mesh = geom::submesh(plate, std::move(facets)).mesh;
  CHECK(number_left(mesh, {2, 75 * degree}) == mesh.num_facets() - 1);
}

TEST_CASE("border teeth: the type is kept, and no tooth is left") {
  std::size_t cut = 0, pinches_less = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    for (const double share : {0.05, 0.3, 0.6}) {
      const TriMesh mesh = torn(seed, share);
      const Tooth tooth{0.15, 80 * degree};
      const geom::Submesh left = geom::submesh(mesh, without_teeth(mesh, tooth));
      cut += mesh.num_facets() - left.facets.size();
      const geom::SurfaceType before = geom::surface_type(mesh), after = geom::surface_type(left.mesh);
      CHECK(sorted_parts(after) == sorted_parts(before));
      CHECK(after.split_vertices <= before.split_vertices);
      CHECK(!after.branches);
      pinches_less += before.split_vertices - after.split_vertices;
      CHECK(number_left(left.mesh, tooth) == left.facets.size());
    }
  CHECK(cut > 400);
  CHECK(pinches_less > 20);
}

TEST_CASE("border teeth: two plates that meet in tips of teeth, or in a tip and a corner") {
  const TriMesh plate = fixtures::sawtooth_plate(20, 1.5);
  const FacetId tooth = FacetId(plate.num_facets() - 1);
  const Vec3 tip = plate.corner(tooth, 2), corner = plate.position(VertexId(0));
  for (const bool tips : {true, false}) {
    // Another one, turned about an axis, with one vertex in common.
    geom::Table<VertexId, Vec3> vertices = plate.vertices();
    geom::Table<FacetId, TriMesh::Facet> facets = plate.facets();
    const auto turned = [](const Vec3& p) { return Vec3(-p[0], -p[1], p[2]); };
    const Vec3 shift = tip - turned(tips ? tip : corner);
    const VertexId at_tip = plate.facet(tooth)[2], at_corner = tips ? at_tip : VertexId(0);
    for (const Vec3& p : plate.vertices()) vertices.push_back(turned(p) + shift);
    for (const TriMesh::Facet& f : plate.facets()) {
      TriMesh::Facet other = f;
      for (VertexId& v : other) v = v == at_corner ? at_tip : VertexId(v.index() + plate.num_vertices());
      facets.push_back(other);
    }
    const TriMesh both(std::move(vertices), std::move(facets));
    REQUIRE(geom::surface_type(both).split_vertices == 1);
    CHECK(number_left(both, {3, 75 * degree}) == 1600);
    CHECK(number_left(both, {1, 75 * degree}) == both.num_facets());
  }
}
