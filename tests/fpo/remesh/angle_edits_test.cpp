// Flips and moves on trial.

#include "fpo/remesh/angle_edits.h"

#include <algorithm>

#include "doctest.h"
#include "geom/mesh/surface_type.h"
#include "tests/fixtures/spoilt_remesh.h"

using namespace fpo;
using fixtures::Spoilt;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

double shortest_edge_at(const EditedMesh& mesh, VertexId v) {
  double least = 1e300;
  for (const VertexId w : mesh.neighbours(v))
    least = std::min(least, (mesh.position(v) - mesh.position(w)).norm());
  return least;
}

}  // namespace

TEST_CASE("angle edits: moves keep to the rules, change their region alone, and are undone") {
  Spoilt s("torus", 6, 0.5);
  const AngleOptions angles;
  const LastAnglesTask task{s.surface, s.sizing, s.features, nullptr, angles};
  AngleEdits edits(task, s.remesh, s.samples);
  const TriMesh before = edits.mesh().mesh();
  geom::Rng rng(7);
  std::size_t kept = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const VertexId v(rng.below(s.remesh.num_vertices()));
    const std::optional<SurfaceSample> to = edits.random_place(v, rng);
    if (!to) continue;  // beyond a sharp bend
    const double wanted = s.sizing.at(edits.sample(v));
    CHECK((to->position - edits.sample(v).position).norm() < wanted / 3);
    const double shortest = shortest_edge_at(edits.mesh(), v);
    const FacetRegion region = edits.region_at(v);
    const AngleScore whole = edits.score(region_of(edits.mesh(), vertices_of(edits.mesh(), region)));
    const AngleScore inner = edits.score(region);
    const std::size_t number = edits.num_edits();
    const TriMesh now = i % 50 == 0 ? edits.mesh().mesh() : TriMesh();
    if (!edits.move(v, *to, region)) {
      ++refused;
      CHECK(edits.num_edits() == number);
      continue;
    }
    CHECK(shortest_edge_at(edits.mesh(), v) >= std::min(shortest, edits.rules.least_edge * wanted));
    const double rise = edits.score(region).penalty - inner.penalty;
    const AngleScore then = edits.score(region_of(edits.mesh(), vertices_of(edits.mesh(), region)));
    CHECK(then.penalty - whole.penalty == doctest::Approx(rise).epsilon(1e-6));
    if (i % 50 != 0) {
      ++kept;
      edits.set_sample(v, *to);
      continue;
    }
    edits.undo_to(number);
    CHECK(edits.mesh().mesh().facets() == now.facets());
    CHECK(edits.mesh().mesh().vertices() == now.vertices());
  }
  CHECK(kept > 200);
  CHECK(refused > 200);
  CHECK(geom::topology(edits.mesh().mesh()).euler == 0);
  CHECK(geom::topology(edits.mesh().mesh()).manifold());
  edits.undo_to(0);
  CHECK(edits.mesh().mesh().facets() == before.facets());
  CHECK(edits.mesh().mesh().vertices() == before.vertices());
}

TEST_CASE("angle edits: edges of curves are not flipped, and angles between two of them are known") {
  Spoilt s("sphere", 6, 0.1);
  const TriMesh::Facet f = s.remesh.facet(FacetId(0));
  const auto id = [](VertexId v) { return SiteId(v.value); };
  const auto is_between = [&] {
    const AngleOptions angles;
    const LastAnglesTask task{s.surface, s.sizing, s.features, nullptr, angles};
    AngleEdits edits(task, s.remesh, s.samples);
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = f[i], b = f[(i + 1) % 3];
      const bool is_of_curve = std::ranges::any_of(s.features.chains, [&](const auto& c) {
        return std::ranges::count(c, id(a)) + std::ranges::count(c, id(b)) == 2;
      });
      if (is_of_curve) CHECK(!edits.flip(a, b));
    }
    return edits.is_between_curves(FacetId(0));
  };
  CHECK(!is_between());
  const std::array<double, 3> angles = angles_of(EditedMesh(s.remesh), FacetId(0));
  const auto least = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
  const VertexId apex = f[least], b = f[(least + 1) % 3], c = f[(least + 2) % 3];
  s.features.chains = {{id(b), id(c)}};
  CHECK(!is_between());
  s.features.chains = {{id(apex), id(b)}};
  CHECK(!is_between());
  s.features.chains = {{id(b), id(apex)}, {id(apex), id(c)}};
  CHECK(is_between());
}
