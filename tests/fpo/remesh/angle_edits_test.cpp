// Flips and moves on trial.

#include "fpo/remesh/angle_edits.h"

#include <algorithm>
#include <array>
#include <cmath>

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

TEST_CASE(
    "angle edits: edges of curves are not flipped, and angles between two of them are stuck if nothing "
    "slides") {
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
    return edits.is_stuck_between_curves(FacetId(0));
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
  CHECK(!is_between());  // its vertices may go anywhere
  s.features.samples = s.samples;
  CHECK(is_between());
}

TEST_CASE("angle edits: an angle between curves is stuck if no slide makes it larger") {
  constexpr int cells = 8;
  const TriMesh plane = geom::make_shape("square", cells);
  const geom::AabbTree tree(plane);
  const auto vertex = [&](int x, int y) {
    const Vec3 wanted(x / double{cells}, y / double{cells}, 0);
    VertexId v(0);
    while ((plane.position(v) - wanted).norm() > 1e-6) v = VertexId(v.value + 1);
    return v;
  };
  for (const bool is_bent : {false, true}) {
    CAPTURE(is_bent);
    FeatureCurve flat, steep;  // from (2, 2), the second one bent at (4, 4)
    for (int k = 2; k <= 7; ++k) flat.vertices.push_back(vertex(k, 2));
    for (int k = 2; k <= 7; ++k) steep.vertices.push_back(is_bent && k > 4 ? vertex(4, k) : vertex(k, k));
    Features features;
    features.corners = {flat.vertices.front(), flat.vertices.back(), steep.vertices.back()};
    for (FeatureCurve* curve : {&flat, &steep}) {
      curve->sheets = 2;
      for (std::size_t i = 0; i + 1 < curve->vertices.size(); ++i) {
        const Vec3 middle = (plane.position(curve->vertices[i]) + plane.position(curve->vertices[i + 1])) / 2;
        curve->facets.push_back(tree.closest(middle).facet);
      }
      features.curves.push_back(*curve);
    }
    const auto place = [&](VertexId v) {
      return SurfaceSample{plane.position(v), tree.closest(plane.position(v)).facet};
    };
    const double h = std::sqrt(8.0) / cells;
    const Vec3 beside = plane.position(flat.vertices[0]) + Vec3(h, 0, 0);
    std::vector<SurfaceSample> samples = {place(flat.vertices[0]),
                                          place(flat.vertices[5]),
                                          place(steep.vertices[5]),
                                          {beside, tree.closest(beside).facet},
                                          place(steep.vertices[2])};
    FeatureSamples on_curves;
    on_curves.samples = samples;
    on_curves.num_given = 3;
    on_curves.chains = {{SiteId(0), SiteId(3), SiteId(1)}, {SiteId(0), SiteId(4), SiteId(2)}};
    on_curves.sheets = {2, 2};
    const Sizing sizing = Sizing::uniform(h);
    const CurveSlides slides(plane, features, on_curves, sizing);
    geom::Table<VertexId, Vec3> at;
    for (const SurfaceSample& x : samples) at.push_back(x.position);
    geom::Table<FacetId, TriMesh::Facet> facets;
    for (const auto& [a, b, c] : {std::array{0, 3, 4}, std::array{3, 1, 2}, std::array{3, 2, 4}})
      facets.push_back({VertexId(static_cast<std::size_t>(a)), VertexId(static_cast<std::size_t>(b)),
                        VertexId(static_cast<std::size_t>(c))});
    const TriMesh remesh(at, facets);
    const AngleOptions angles;
    const LastAnglesTask task{plane, sizing, on_curves, &slides, angles};
    AngleEdits edits(task, remesh, samples);
    CHECK(!edits.places(VertexId(4)).empty());
    CHECK(edits.is_stuck_between_curves(FacetId(0)) == !is_bent);
    CHECK(!edits.is_stuck_between_curves(FacetId(2)));
  }
}
