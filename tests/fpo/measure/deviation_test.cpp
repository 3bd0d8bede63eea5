#include "fpo/measure/deviation.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/measure/hausdorff.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "tests/fixtures/surfaces.h"

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

TriMesh shifted(const TriMesh& mesh, const Vec3& by) {
  Table<VertexId, Vec3> vertices;
  for (const Vec3& p : mesh.vertices()) vertices.push_back(p + by);
  return TriMesh(std::move(vertices), mesh.facets());
}

/// A unit square of k x k squares.
TriMesh square(int k, double height) {
  Table<VertexId, Vec3> v;
  Table<FacetId, TriMesh::Facet> f;
  fixtures::add_grid(v, f, k, Vec3(0, 0, height), Vec3(1, 0, 0), Vec3(0, 1, 0));
  return TriMesh(std::move(v), std::move(f));
}

}  // namespace

TEST_CASE("facet_deviations: parallel squares are one distance apart everywhere") {
  for (const auto& [mesh, reference] :
       {std::pair(square(5, 0), square(3, 0.25)), std::pair(square(2, 0), square(9, 0.25))})
    for (const double d : fpo::facet_deviations(mesh, reference)) CHECK(d == doctest::Approx(0.25));
}

TEST_CASE("facet_deviations: at most the Hausdorff distance, at least that of each facet's own middle") {
  const TriMesh mesh = fixtures::blob(6), reference = shifted(fixtures::blob(9), Vec3(0.1, -0.05, 0.02));
  const Table<FacetId, double> found = fpo::facet_deviations(mesh, reference);
  REQUIRE(found.size() == mesh.num_facets());
  const fpo::SurfaceDistance distance = fpo::surface_distance(mesh, reference);
  CHECK(*std::ranges::max_element(found) <= distance.max_bound);
  CHECK(*std::ranges::max_element(found) > 0.9 * distance.max);
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    double nearest2 = 1e300;
    const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
    for (FacetId s(0); s.index() < reference.num_facets(); s = FacetId(s.value + 1))
      nearest2 = std::min(
          nearest2, geom::closest_point(
                        middle, {reference.corner(s, 0), reference.corner(s, 1), reference.corner(s, 2)})
                        .distance2);
    CHECK(found[t] >= std::sqrt(nearest2) * (1 - 1e-12));
  }
}

TEST_CASE("facet_deviations: what the mesh leaves out counts where it is nearest") {
  // The reference has a second square far above: seen from there, the facets below are far.
  const TriMesh mesh = square(4, 0);
  Table<VertexId, Vec3> v;
  Table<FacetId, TriMesh::Facet> f;
  fixtures::add_grid(v, f, 4, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  fixtures::add_grid(v, f, 1, Vec3(0, 0, 3), Vec3(0.2, 0, 0), Vec3(0, 0.2, 0));
  const Table<FacetId, double> found = fpo::facet_deviations(mesh, TriMesh(std::move(v), std::move(f)));
  CHECK(*std::ranges::max_element(found) == doctest::Approx(3));
  CHECK(std::ranges::count_if(found, [](double d) { return d > 1e-9; }) <= 4);
}

TEST_CASE("facet_deviations: any number of threads; a mesh without facets is refused") {
  const TriMesh mesh = fixtures::blob(6), reference = fixtures::blob(7);
  const Table<FacetId, double> one = fpo::facet_deviations(mesh, reference, 1);
  CHECK(std::ranges::equal(one, fpo::facet_deviations(mesh, reference, 3)));
  CHECK_THROWS_AS(fpo::facet_deviations(TriMesh(), reference), geom::InputError);
}
