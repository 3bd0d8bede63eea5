// Facets that are missing at a border come back; what is meant stays.

#include "geom/repair/dents.h"

#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/repair/repair.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"

namespace {

using namespace fixtures;

std::size_t fill(MeshArrays& mesh) { return geom::fill_dents(mesh.vertices, mesh.facets, {}); }

/// Without every `step`-th facet that has an edge on the border.
TriMesh nibbled(const TriMesh& mesh, std::size_t step, std::size_t& lost) {
  MeshArrays result = arrays_of(mesh);
  result.facets.clear();
  std::size_t at_border = 0;
  lost = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    int edges = 0;
    for (int e = 0; e < 3; ++e) edges += !mesh.across(t, e).valid();
    if (edges == 1 && ++at_border % step == 0)
      ++lost;
    else
      result.facets.push_back(mesh.facet(t));
  }
  return result.take();
}

}  // namespace

TEST_CASE("dents: facets lost at a border come back, and the border is as it was") {
  const TriMesh whole = geom::make_shape("tube", 80);
  const geom::Topology before = geom::topology(whole);
  std::size_t lost = 0;
  MeshArrays mesh = arrays_of(nibbled(whole, 9, lost));
  REQUIRE(lost > 3);
  CHECK(fill(mesh) == lost);
  const TriMesh filled = mesh.take();
  const geom::Topology after = geom::topology(filled);
  CHECK(after.manifold());
  CHECK(after.misoriented_edges == 0);
  CHECK(after.boundary_edges == before.boundary_edges);
  CHECK(after.boundary_loops == before.boundary_loops);
  CHECK(after.euler == before.euler);
  CHECK(filled.area() == doctest::Approx(whole.area()));
}

TEST_CASE("dents: a sound border, corners and teeth have none") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    MeshArrays arrays = arrays_of(mesh);
    CHECK(fill(arrays) == 0);
  }
  MeshArrays saw;  // a disk with a hundred teeth
  const std::size_t teeth = 100;
  saw.add(Vec3(0, 0, 0));
  for (std::size_t i = 0; i < 2 * teeth; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / teeth, r = i % 2 == 0 ? 1 : 0.9;
    saw.add(Vec3(r * std::cos(angle), r * std::sin(angle), 0));
  }
  for (std::size_t i = 0; i < 2 * teeth; ++i)
    saw.add_triangle(VertexId(0), VertexId(1 + i), VertexId(1 + (i + 1) % (2 * teeth)));
  CHECK(fill(saw) == 0);
}

TEST_CASE("repair: fills dents last, and says so; the result has none") {
  std::size_t lost = 0;
  const TriMesh spoilt = nibbled(geom::make_shape("tube", 80), 20, lost);
  const geom::Repaired result = geom::repaired(spoilt, geom::all_steps());
  REQUIRE(!result.lines.empty());
  CHECK(result.lines.back().starts_with("filled " + std::to_string(lost) + " dents"));
  CHECK(geom::repaired(result.mesh, geom::all_steps()).mesh.num_facets() == result.mesh.num_facets());
}
