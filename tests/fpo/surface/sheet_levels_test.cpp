#include "fpo/surface/sheet_levels.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

std::optional<SplitSurface> apart(const TriMesh& mesh, double h) {
  return sheets_apart(mesh, Sizing::uniform(h), {});
}

/// No edge is steeper.
void check_slopes(const TriMesh& mesh, double slope) {
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t e = 0; e < 3; ++e) {
      const VertexId a = f[e], b = f[(e + 1) % 3];
      CHECK(std::abs(mesh.level(a) - mesh.level(b)) <=
            slope * (mesh.position(a) - mesh.position(b)).norm() * (1 + 1e-9));
    }
}

RemeshOptions options_for(std::size_t n) {
  RemeshOptions options = default_options(n, SizingKind::uniform);
  options.features.reset();
  options.optimize.max_iterations = 12;
  options.improve_fidelity = false;
  options.sheets = Sheets::apart;
  return options;
}

}  // namespace

TEST_CASE("sheets apart: nothing where no sheets are near") {
  CHECK(!apart(geom::make_shape("sphere", 8), 0.2));
  CHECK(!apart(geom::make_shape("torus", 24), 0.2));
  CHECK(!apart(fixtures::box(Vec3(1, 1, 1), 4), 0.15));
}

TEST_CASE("sheets apart: opposite places of a plate differ by the way around its rim, or wholly") {
  const double h = 0.08;
  const SheetOptions options;
  const std::optional<SplitSurface> plate = apart(fixtures::box(Vec3(1, 1, 0.01), 1), h);
  REQUIRE(plate);
  const TriMesh& mesh = plate->mesh;
  check_slopes(mesh, options.slope);
  std::size_t pairs = 0;
  for (VertexId a(0); a.index() < mesh.num_vertices(); a = VertexId(a.value + 1))
    for (VertexId b(0); b.index() < mesh.num_vertices(); b = VertexId(b.value + 1)) {
      const Vec3 &p = mesh.position(a), &q = mesh.position(b);
      if (p.z() != 0 || q.z() == 0 || std::hypot(p.x() - q.x(), p.y() - q.y()) > 0.3 * h) continue;
      const double rim = std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()});
      ++pairs;
      const double around = std::min(rim, 0.4 * options.far * h) + rim;
      const double least = std::min(options.height * h, options.slope * (around - 0.6 * h));
      CHECK(std::abs(mesh.level(a) - mesh.level(b)) >= least - 1e-9);
    }
  CHECK(pairs > 30);
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    CHECK(plate->parents[t].index() < 12);
}

TEST_CASE("sheets apart: components that are near have levels of their own, all of them") {
  const TriMesh boxes = geom::make_shape("two-spheres", 10);
  const std::optional<SplitSurface> surface = apart(boxes, 0.3);
  REQUIRE(surface);
  std::vector<double> levels;
  for (VertexId v(0); v.index() < surface->mesh.num_vertices(); v = VertexId(v.value + 1))
    levels.push_back(surface->mesh.level(v));
  std::ranges::sort(levels);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  CHECK(levels.size() == 2);
  CHECK(levels.back() - levels.front() >= 1.4 * 0.3);
}

TEST_CASE("sheets apart: a paper-thin plate is remeshed without mending, at any number of threads") {
  const TriMesh plate = fixtures::box(Vec3(1, 1, 0.01), 1);
  RemeshOptions options = options_for(200);
  const RemeshResult result = remesh(plate, options);
  CHECK(result.has_levels);
  CHECK(result.brought == 0);
  const geom::Topology type = geom::topology(result.mesh);
  CHECK(type.manifold());
  CHECK(type.euler == 2);
  CHECK(type.boundary_edges == 0);
  CHECK(result.mesh.num_vertices() == 200);
  for (const SurfaceSample& x : result.samples) CHECK(x.facet.index() < 12);
  for (const Engine engine : {Engine::search, Engine::triangulation}) {
    options.threads = 3;
    options.surface.engine = engine;
    const RemeshResult again = remesh(plate, options);
    CHECK(again.mesh.vertices() == result.mesh.vertices());
    CHECK(again.mesh.facets() == result.mesh.facets());
  }
}

TEST_CASE("sheets apart: facets of a thread are not split without end") {
  const TriMesh thread = geom::mapped(geom::make_shape("cube"), [](const Vec3& p) -> Vec3 {
    return {1e9 * p.x(), 1e-3 * p.y(), 1e-3 * p.z()};
  });
  CHECK(!apart(thread, 100));
}

TEST_CASE("sheets apart: the optimization ends where it gains no more; nowhere else") {
  const TriMesh plate = fixtures::box(Vec3(1, 1, 0.01), 1);
  RemeshOptions options = default_options(200, SizingKind::uniform);
  options.improve_fidelity = false;
  options.sheets = Sheets::apart;
  const OptimizeResult apart = remesh(plate, options).optimization;
  CHECK(apart.reason == StopReason::nothing_gained);
  CHECK(apart.last.iteration < options.optimize.max_iterations);
  const OptimizeResult sphere = remesh(geom::make_shape("sphere"), options).optimization;
  CHECK(sphere.reason != StopReason::nothing_gained);
}
