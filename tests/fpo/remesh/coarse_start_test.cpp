// Few samples on surfaces of many facets.

#include "fpo/remesh/coarse_start.h"

#include <cmath>

#include "doctest.h"
#include "fpo/measure/quality.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/io/sample_meshes.h"

using namespace fpo;

namespace {

using geom::TriMesh;

double spacing_of(const TriMesh& mesh, std::size_t n) { return hexagonal_spacing(mesh.area(), n); }

double distance(const geom::Vec3& x, const TriMesh& mesh, geom::FacetId t) {
  return std::sqrt(
      geom::closest_point(x, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}).distance2);
}

RemeshOptions short_run(std::size_t n, SizingKind sizing = SizingKind::uniform) {
  RemeshOptions options = default_options(n, sizing);
  options.optimize.max_iterations = 24;
  options.closer = Closer::never;
  return options;
}

}  // namespace

TEST_CASE("coarse start: a surface near the given one, of its type, with less than half the facets") {
  for (const auto& [name, size, n] : {std::tuple("blob", 30, 150UL), std::tuple("double-torus", 60, 200UL),
                                      std::tuple("wave-disk", 60, 60UL), std::tuple("horn", 40, 120UL)}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name, size);
    REQUIRE(mesh.num_facets() >= 30 * n);
    const double h = spacing_of(mesh, n);
    const auto coarse = coarse_surface(mesh, Sizing::uniform(h), n);
    REQUIRE(coarse);
    CHECK(2 * coarse->num_facets() <= mesh.num_facets());
    CHECK(coarse->num_facets() > 8 * n);
    const geom::Topology before = geom::topology(mesh), after = geom::topology(*coarse);
    CHECK(after.manifold());
    CHECK(after.euler == before.euler);
    CHECK(after.boundary_loops == before.boundary_loops);
    CHECK(after.misoriented_edges == 0);
    const geom::AabbTree there(*coarse);
    double most = 0;
    for (std::size_t t = 0; t < mesh.num_facets(); ++t)
      most = std::max(most, there.closest(mesh.corner(geom::FacetId(t), 0)).distance2);
    CHECK(std::sqrt(most) < h / 3);  // the tip of the horn goes
  }
}

TEST_CASE("coarse start: only where facets are many, and become fewer") {
  const TriMesh mesh = geom::make_shape("blob", 20);
  const auto coarse_for = [&](std::size_t n) {
    return coarse_surface(mesh, Sizing::uniform(spacing_of(mesh, n)), n);
  };
  CHECK(coarse_for(100));
  CHECK(!coarse_for(mesh.num_facets() / 30 + 1));
  const double tiny = spacing_of(mesh, 100) / 20;  // facets are as large as that already
  CHECK(!coarse_surface(mesh, Sizing::uniform(tiny), 100));
}

TEST_CASE("coarse start: lengths that differ are those of the input") {
  const TriMesh mesh = geom::make_shape("blob", 24);
  VertexField h;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v)
    h.push_back(spacing_of(mesh, 150) * (1 + 0.5 * std::abs(mesh.position(geom::VertexId(v)).x())));
  const Sizing sizing(mesh, h);
  const auto coarse = coarse_surface(mesh, sizing, 150);
  REQUIRE(coarse);
  const Sizing there = sizing_on(*coarse, sizing);
  for (std::size_t v = 0; v < h.size(); ++v) CHECK(there.at(geom::VertexId(v)) == h[geom::VertexId(v)]);
}

TEST_CASE("coarse start: iterations and moves are counted on, and none is told twice") {
  const TriMesh mesh = geom::make_shape("blob", 20);
  RemeshOptions options = short_run(100);
  options.optimize.target_delta = 2;
  std::vector<IterationReport> told;
  std::size_t moves = 0;
  options.optimize.on_iteration = [&](const IterationReport& report) { told.push_back(report); };
  options.optimize.on_move = [&](std::size_t move) { CHECK(move == moves++); };
  const RemeshResult result = remesh(mesh, options);
  REQUIRE(result.coarse_facets > 0);
  REQUIRE(told.size() == 25);
  for (std::size_t i = 0; i < told.size(); ++i) CHECK(told[i].iteration == static_cast<int>(i));
  CHECK(result.optimization.moves == moves);
  CHECK(result.optimization.last.iteration == 24);
  CHECK(result.iterations.size() == told.size());
}

TEST_CASE("coarse start: the remesh is as good as one without, its samples on the input") {
  for (const SizingKind sizing : {SizingKind::uniform, SizingKind::local_feature_size}) {
    const TriMesh mesh = geom::make_shape("double-torus", 60);
    RemeshOptions options = short_run(250, sizing);
    options.fixed = {mesh.position(geom::VertexId(7)), mesh.position(geom::VertexId(1000))};
    const RemeshResult with = remesh(mesh, options);
    options.coarse_start = false;
    const RemeshResult without = remesh(mesh, options);
    CHECK(with.coarse_facets > 0);
    CHECK(without.coarse_facets == 0);
    CHECK(with.type.ok());
    CHECK(with.mesh.num_vertices() == 250);
    CHECK(with.measures.theta_min >= 30);
    CHECK(std::abs(with.optimization.last.mean_delta - without.optimization.last.mean_delta) < 0.02);
    for (const SurfaceSample& x : with.samples) CHECK(distance(x.position, mesh, x.facet) < 1e-12);
    for (std::size_t i = 0; i < 2; ++i) CHECK(with.samples[i].position == options.fixed[i]);
  }
}

TEST_CASE("coarse start: the same bytes from both engines, in tiles with one thread and two") {
  const TriMesh mesh = geom::make_shape("blob", 24);
  RemeshOptions options = short_run(150);
  const RemeshResult first = remesh(mesh, options);
  REQUIRE(first.coarse_facets > 0);
  options.surface.engine = Engine::triangulation;
  CHECK(fixtures::identical(remesh(mesh, options).mesh, first.mesh));
  options.surface.engine = Engine::search;
  options.tile_samples = 50;
  const RemeshResult tiled = remesh(mesh, options);
  options.threads = 2;
  CHECK(fixtures::identical(remesh(mesh, options).mesh, tiled.mesh));
}

TEST_CASE("coarse start: interrupted in either part there is a whole set on the input") {
  const TriMesh mesh = geom::make_shape("blob", 20);
  for (const std::size_t last : {500UL, 1900UL}) {
    std::atomic<bool> stop = false;
    RemeshOptions options = short_run(100);
    options.optimize.target_delta = 2;
    options.optimize.interrupted = &stop;
    options.optimize.on_move = [&](std::size_t move) { stop = stop || move == last; };
    const RemeshResult result = remesh(mesh, options);
    CHECK(result.optimization.reason == StopReason::interrupted);
    CHECK(result.optimization.moves <= last + 1);
    CHECK(result.samples.size() == 100);
    for (const SurfaceSample& x : result.samples) CHECK(distance(x.position, mesh, x.facet) < 1e-12);
  }
}
