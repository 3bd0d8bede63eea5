#include "fpo/remesh/pipeline.h"

#include <array>
#include <atomic>
#include <string>

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

namespace {

RemeshResult run(const geom::TriMesh& mesh, std::size_t n, Engine engine, std::uint64_t seed = 1) {
  RemeshOptions options;
  options.num_samples = n;
  options.seed = seed;
  options.surface.engine = engine;
  options.optimize.max_iterations = 6;
  return remesh(mesh, options);
}

bool same(const geom::TriMesh& a, const geom::TriMesh& b) {
  return a.vertices() == b.vertices() && a.facets() == b.facets();
}

}  // namespace

TEST_CASE("pipeline: both engines give the same bits, a repeated run too, another seed does not") {
  const std::size_t samples = fixtures::effort(80, 150);
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const RemeshResult a = run(surface.mesh, samples, Engine::search),
                       b = run(surface.mesh, samples, Engine::triangulation);
    CHECK(a.mesh.num_vertices() == samples);
    CHECK(same(a.mesh, b.mesh));
    CHECK(a.optimization.last.delta == b.optimization.last.delta);
    if (fixtures::effort(false, true)) CHECK(same(a.mesh, run(surface.mesh, samples, Engine::search).mesh));
  }
  const geom::TriMesh blob = fixtures::blob(10);
  const RemeshResult once = run(blob, samples, Engine::search);
  CHECK(same(once.mesh, run(blob, samples, Engine::search).mesh));
  CHECK(!same(once.mesh, run(blob, samples, Engine::search, 2).mesh));
}

TEST_CASE(
    "pipeline: adaptive, with removal of short edges, local and global: both engines give the same bits") {
  const std::size_t samples = fixtures::effort(60, 150);
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Scope scope : {Scope::global, Scope::two_ring})
      for (const geom::CornerTypes corners : {geom::CornerTypes::c_only, geom::CornerTypes::all}) {
        const bool is_one_of_few = (scope == Scope::global) == (corners == geom::CornerTypes::all);
        if (!fixtures::effort(is_one_of_few, true)) continue;
        CAPTURE(surface.name);
        RemeshOptions options;
        options.num_samples = samples;
        options.sheets = Sheets::together;  // few samples: they would all be remeshed once more
        options.sizing = SizingKind::given;
        for (const geom::Vec3& p : surface.mesh.vertices())
          options.rho.push_back(1 + std::abs(p.x() + p.y()));
        options.limits.gradation = 0.3;
        options.shortest_edge_removal = scope == Scope::two_ring;
        options.surface.corners = corners;
        options.optimize.scope = scope;
        options.optimize.max_iterations = 3;
        const RemeshResult a = remesh(surface.mesh, options);
        options.surface.engine = Engine::triangulation;
        const RemeshResult b = remesh(surface.mesh, options);
        CHECK(a.mesh.num_vertices() == samples);
        CHECK(same(a.mesh, b.mesh));
        CHECK(a.optimization.last.delta == b.optimization.last.delta);
        CHECK(a.shortest_edges.moves == b.shortest_edges.moves);
      }
}

TEST_CASE("pipeline: edge lengths follow the sizing") {
  const geom::TriMesh mesh = fixtures::blob(10);
  RemeshOptions options;
  options.num_samples = 1200;
  options.sizing = SizingKind::given;
  for (const geom::Vec3& p : mesh.vertices()) options.rho.push_back(2.2 + 1.6 * p.x());
  options.optimize.scope = Scope::two_ring;
  options.optimize.max_iterations = 15;
  const RemeshResult result = remesh(mesh, options);
  CHECK(result.fit.slope == doctest::Approx(1).epsilon(0.06));
  CHECK(result.fit.cv < 0.16);
  CHECK(result.hidden == 0);
  CHECK(result.angles.bad_after == 0);
  CHECK(geom::topology(result.mesh).manifold());
}

TEST_CASE("pipeline: a scaled input gives the scaled output, from tiny to huge") {
  const geom::TriMesh mesh = fixtures::blob(5);
  const RemeshResult unit = run(mesh, 100, Engine::search);
  for (const int exponent : {-120, -3, 7, 130}) {
    const double factor = std::ldexp(1.0, exponent);
    geom::Table<geom::VertexId, geom::Vec3> vertices = mesh.vertices();
    for (geom::Vec3& v : vertices) v *= factor;
    const RemeshResult result = run(geom::TriMesh(std::move(vertices), mesh.facets()), 100, Engine::search);
    for (std::size_t i = 0; i < 100; ++i)
      CHECK(result.mesh.position(geom::VertexId(i)) == unit.mesh.position(geom::VertexId(i)) * factor);
    CHECK(result.mesh.facets() == unit.mesh.facets());
  }
}

TEST_CASE("pipeline: a closed smooth surface keeps its topology, and delta grows") {
  const geom::TriMesh mesh = fixtures::blob(8);
  RemeshOptions options;
  options.num_samples = 300;
  std::vector<double> deltas;
  options.optimize.max_iterations = 20;
  options.optimize.on_iteration = [&](const IterationReport& r) { deltas.push_back(r.delta); };
  const RemeshResult result = remesh(mesh, options);
  const geom::Topology t = geom::topology(result.mesh);
  CHECK(t.manifold());
  CHECK(t.euler == 2);
  CHECK(t.boundary_edges == 0);
  CHECK(t.misoriented_edges == 0);
  CHECK(t.unreferenced_vertices == 0);
  for (std::size_t i = 1; i < deltas.size(); ++i) CHECK(deltas[i] >= deltas[i - 1] - 1e-12);
  CHECK(deltas.back() > 0.85);
}

TEST_CASE("pipeline: a plate thinner than the spacing of its samples is closed and of genus 0") {
  const geom::TriMesh plate = fixtures::box(geom::Vec3(1, 1, 0.05), 6);
  RemeshOptions options;
  options.num_samples = 150;
  options.optimize.max_iterations = 5;
  options.sheets = Sheets::together;
  const RemeshResult result = remesh(plate, options);
  const geom::Topology t = geom::topology(result.mesh);
  CHECK(result.localization.orphans > 0);
  CHECK(result.localization.remaining == 0);
  CHECK(result.mesh.num_vertices() == 150);
  MESSAGE("plate: euler ", t.euler, ", non-manifold edges ", t.nonmanifold_edges);
}

TEST_CASE("pipeline: sheets of a surface with an edge of three facets are set apart, too") {
  const geom::TriMesh head = geom::make_shape("sphere", 6);
  const geom::TriMesh eye = geom::mapped(head, [](const geom::Vec3& p) {
    return geom::Vec3(0.4 * p + geom::Vec3(0.85, 0.1, 0.05));
  });  // they cross each other
  const geom::TriMesh both = geom::joined(head, eye);
  geom::MeshArrays mesh{both.vertices(), both.facets()};
  const geom::TriMesh::Facet f = mesh.facets[geom::FacetId(head.num_facets() / 2)];
  const geom::Vec3 middle = (mesh.vertices[f[0]] + mesh.vertices[f[1]]) / 2;
  const double length = (mesh.vertices[f[0]] - mesh.vertices[f[1]]).norm();
  mesh.add_triangle(f[1], f[0], mesh.add(middle + length * middle.normalized()));
  const RemeshResult result = remesh(mesh.take(), default_options(600, SizingKind::uniform));
  CHECK(result.type.ok());
  CHECK(result.has_levels);
  CHECK(result.measures.theta_min >= 30);
}

TEST_CASE(
    "pipeline: sheets near each other that put cells at fault early are set apart before all iterations") {
  const geom::TriMesh ears = geom::make_shape("ears", 40);
  RemeshOptions options = default_options(200, SizingKind::uniform);
  options.features.reset();
  options.coarse_start = false;
  int reports = 0;
  options.optimize.on_iteration = [&](const IterationReport&) { ++reports; };
  const RemeshResult apart = remesh(ears, options);
  CHECK(apart.has_levels);
  CHECK(apart.type.ok());
  CHECK(apart.mesh.num_vertices() == 200);
  CHECK(apart.measures.theta_min >= 30);
  CHECK(reports < 60);  // twenty together, a third of all apart, and two beginnings
  reports = 0;
  options.sheets = Sheets::together;
  remesh(ears, options);
  CHECK(reports > options.optimize.max_iterations);
}

TEST_CASE("pipeline: interrupted while it is looked for faults, or soon after, what was optimized is kept") {
  for (const auto& [n, last] : {std::pair(200UL, 10), std::pair(1000UL, 24)}) {
    CAPTURE(n);
    RemeshOptions options = default_options(n, SizingKind::uniform);
    options.features.reset();
    options.coarse_start = false;
    std::atomic<bool> interrupted = false;
    options.optimize.interrupted = &interrupted;
    int reports = 0, iteration = 0;
    options.optimize.on_iteration = [&](const IterationReport& report) {
      if (++reports == last) interrupted = true;
      if (reports == last) iteration = report.iteration;
    };
    const RemeshResult result = remesh(geom::make_shape("ears", 40), options);
    CHECK(interrupted);
    CHECK(iteration < 10);  // of 1000 samples, which have no faults after twenty: all has begun anew
    CHECK(result.optimization.moves >= 9 * n);
    CHECK(result.optimization.reason == StopReason::interrupted);
    CHECK(result.mesh.num_vertices() == n);
    CHECK(result.optimization.last.mean_delta > 0.8);
  }
}

TEST_CASE("pipeline: fidelity has its turn where closeness gains nothing") {
  int left_out = 0, in_vain = 0;
  const auto compare = [&](const geom::TriMesh& mesh, std::size_t n) {
    CAPTURE(n);
    RemeshOptions options = default_options(n, SizingKind::uniform);
    const RemeshResult result = remesh(mesh, options);
    CHECK((result.closeness.mended > 0) != (result.fidelity.tried > 0));
    options.closer = Closer::never;
    const RemeshResult other = remesh(mesh, options);
    CHECK(other.closeness.tried == 0);
    CHECK(other.fidelity.tried > 0);
    left_out += result.fidelity.tried == 0;
    if (result.closeness.mended > 0) return;
    in_vain += result.closeness.tried > 0;
    CHECK(result.mesh.vertices() == other.mesh.vertices());
  };
  for (const std::size_t n : {200, 400, 800}) compare(fixtures::blob(8), n);
  compare(geom::make_shape("torus", 48), 300);
  compare(geom::make_shape("torus", 96), 300);
  CHECK(left_out > 0);
  CHECK(in_vain > 0);
}

TEST_CASE("pipeline: where edges of curves are lost samples of close curves face each other in the end") {
  RemeshOptions options;
  options.num_samples = 900;
  options.features = FeatureOptions();
  options.optimize.max_iterations = 1;
  options.optimize_angles = options.improve_fidelity = false;
  options.mend = false;  // nor are edges made by flips
  const geom::TriMesh plate = geom::make_shape("hole-plate");
  options.sheets = Sheets::together;
  const RemeshResult plain = remesh(plate, options);
  options.sheets = Sheets::automatic;
  const RemeshResult best = remesh(plate, options);
  CHECK(plain.broken_feature_edges > 20);
  CHECK(4 * best.broken_feature_edges < plain.broken_feature_edges);
  CHECK(!plain.has_facing_samples);
  CHECK(best.has_facing_samples);
}

TEST_CASE("pipeline: creases that nobody asked for are given up where angles beside them are small") {
  const geom::TriMesh plate = geom::make_shape("hole-plate");  // holes near its border
  RemeshOptions options = default_options(500, SizingKind::uniform);
  options.optimize.max_iterations = 10;
  options.features->yielding = false;
  const RemeshResult all = remesh(plate, options);
  options.features->yielding = true;
  const RemeshResult result = remesh(plate, options);
  CHECK(all.given_up.empty());
  CHECK(all.measures.angles_below_30 > 20);
  CHECK(result.given_up.find("for small angles beside them") != std::string::npos);
  CHECK(2 * result.measures.angles_below_30 < all.measures.angles_below_30);
  CHECK(3 * result.crease_curves > all.crease_curves);
  CHECK(result.type.ok());
}

TEST_CASE("pipeline: of long straight creases that meet at a small angle one ends earlier") {
  const geom::TriMesh wedge = geom::make_shape("wedge");  // 15 degrees
  RemeshOptions options = default_options(400, SizingKind::uniform);
  const RemeshResult result = remesh(wedge, options);
  CHECK(result.mesh.num_vertices() == 400);
  CHECK(result.type.ok());
  CHECK(result.measures.theta_min >= 30);
  CHECK(result.given_up.find("2 of 9 curves, in part") != std::string::npos);
  CHECK(result.sizing.size() == wedge.num_vertices());
  for (const SurfaceSample& x : result.samples) {
    REQUIRE(x.facet.index() < wedge.num_facets());
    const std::array facet{wedge.corner(x.facet, 0), wedge.corner(x.facet, 1), wedge.corner(x.facet, 2)};
    CHECK(geom::closest_point(x.position, facet).distance2 < 1e-20);
  }
}

TEST_CASE("pipeline: no iterations are none, in further attempts too") {
  RemeshOptions options = default_options(200, SizingKind::uniform);
  options.optimize.max_iterations = 0;
  options.optimize_angles = options.improve_fidelity = options.mend = false;
  const RemeshResult result = remesh(geom::make_shape("plate"), options);
  CHECK(result.measures.theta_min < 30);  // so that there are such
  CHECK(result.optimization.moves == 0);
}

TEST_CASE("pipeline: tiles, with features, sizes and shortest edge removal, give the same with any threads") {
  const geom::TriMesh mesh = fixtures::box(geom::Vec3(1, 1, 1), 1);  // large facets, which are split
  for (const SizingKind sizing : {SizingKind::uniform, SizingKind::curvature}) {
    RemeshOptions options;
    options.num_samples = 600;
    options.sizing = sizing;
    options.features = automatic_features();
    options.shortest_edge_removal = true;
    options.tile_samples = 150;
    options.optimize.max_iterations = 5;
    const RemeshResult one = remesh(mesh, options);
    const geom::Topology t = geom::topology(one.mesh);
    CHECK(t.manifold());
    CHECK(t.euler == 2);
    CHECK(one.broken_feature_edges == 0);
    CHECK(one.optimization.moves == 5 * (600 - one.feature_samples));
    for (const SurfaceSample& x : one.samples) CHECK(x.facet.index() < mesh.num_facets());
    options.threads = 3;
    CHECK(same(remesh(mesh, options).mesh, one.mesh));
  }
}

TEST_CASE("pipeline: interruption keeps all samples; too few samples are refused") {
  const geom::TriMesh mesh = fixtures::blob(5);
  std::atomic<bool> stop{false};
  RemeshOptions options;
  options.num_samples = 80;
  options.optimize.interrupted = &stop;
  options.optimize.on_move = [&](std::size_t move) { stop = move >= 100; };
  const RemeshResult result = remesh(mesh, options);
  CHECK(result.optimization.reason == StopReason::interrupted);
  CHECK(result.optimization.moves == 101);
  CHECK(result.mesh.num_vertices() == 80);
  CHECK_THROWS_AS(remesh(mesh, options), geom::Interrupted);  // before it has begun
  stop = false;
  options.num_samples = 1;
  CHECK_THROWS_AS(remesh(mesh, options), geom::InputError);
  options.num_samples = 0;
  CHECK_THROWS_AS(remesh(mesh, options), geom::InputError);
}
