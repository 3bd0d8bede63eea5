// The other methods through the whole pipeline.

#include <array>
#include <map>

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

namespace {

bool has_disks(Method m) {
  return m == Method::cps || m == Method::pps || m == Method::mps || m == Method::hps;
}

RemeshOptions raw(Method method, std::size_t n) {
  RemeshOptions options;
  options.method = method;
  options.num_samples = n;
  options.optimize.max_iterations = has_disks(method) ? 6 : method == Method::ccst ? 4 : 40;
  options.optimize_angles = options.improve_fidelity = false;
  return options;
}

constexpr std::array others{Method::cvt, Method::cps,  Method::pps, Method::mps,
                            Method::hps, Method::ccst, Method::vbs};

}  // namespace

TEST_CASE("methods: each has one line in the table; one that has none is not taken for another") {
  for (const MethodFacts& m : methods()) CHECK(&facts_of(m.method) == &m);
  for (const Method m : others) CHECK(bool(facts_of(m).distribute));
  CHECK(!facts_of(Method::fpo).distribute);
  const Method forgotten = static_cast<Method>(methods().size());
  CHECK_THROWS_AS(facts_of(forgotten), geom::Bug);
  CHECK_THROWS_AS(remesh(geom::make_shape("cube"), raw(forgotten, 50)), geom::Bug);
}

TEST_CASE("baselines: a closed smooth surface keeps its topology; each method has its quality") {
  const geom::TriMesh mesh = geom::make_shape("double-torus", 24);
  std::map<Method, double> q_avg, mean_delta;
  for (const Method method : others) {
    const RemeshResult result = remesh(mesh, raw(method, 700));
    const geom::Topology t = geom::topology(result.mesh);
    CHECK(t.manifold());
    CHECK(t.euler == geom::topology(mesh).euler);
    CHECK(t.unreferenced_vertices == 0);
    CHECK(std::abs(double(result.samples.size()) - 700) <= (has_disks(method) ? 20 : 0));
    const Quality q = quality(result.mesh, mesh.area());
    q_avg[method] = q.q_avg, mean_delta[method] = result.optimization.last.mean_delta;
    const bool maximal = method == Method::mps || method == Method::hps;
    if (maximal) CHECK(q.theta_min > 29.9);  // 30 in the plane: edges >= r, circles <= r
    if (maximal) CHECK(q.theta_max < 120.2);
    CHECK(result.reached.empty() ==
          (method == Method::cvt || method == Method::cps || method == Method::mps));
  }
  // The order of the paper's table 2.
  CHECK(q_avg[Method::cvt] > q_avg[Method::mps] + 0.1);
  CHECK(q_avg[Method::mps] > q_avg[Method::cps] + 0.005);
  CHECK(q_avg[Method::pps] > q_avg[Method::cps] + 0.005);
  CHECK(mean_delta[Method::cvt] > mean_delta[Method::mps]);
  CHECK(mean_delta[Method::mps] > mean_delta[Method::cps]);
  for (const Method m : {Method::pps, Method::hps, Method::ccst, Method::vbs}) {
    CHECK(q_avg[m] > 0.77);
    CHECK(q_avg[m] < 0.87);
  }
}

TEST_CASE("baselines: edge lengths follow the sizing; both engines give the same bits") {
  const geom::TriMesh mesh = fixtures::blob(10);
  for (const Method method : others) {
    RemeshOptions options = raw(method, 500);
    options.optimize.max_iterations = has_disks(method) ? 5 : 15;
    options.sizing = SizingKind::given;
    for (const geom::Vec3& p : mesh.vertices()) options.rho.push_back(2.2 + 1.6 * p.x());
    const RemeshResult a = remesh(mesh, options);
    options.surface.engine = Engine::triangulation;
    options.threads = 3;
    const RemeshResult b = remesh(mesh, options);
    CHECK(a.fit.slope == doctest::Approx(1).epsilon(method == Method::ccst ? 0.12 : 0.06));
    CHECK(a.hidden == 0);
    CHECK(a.mesh.vertices() == b.mesh.vertices());
    CHECK(a.mesh.facets() == b.mesh.facets());
  }
}

TEST_CASE("baselines: creases are kept") {
  const geom::TriMesh mesh = geom::make_shape("l-block");
  for (const Method method : others)
    for (const bool adaptive : {false, true}) {
      RemeshOptions options = raw(method, 500);
      options.features = automatic_features();
      if (adaptive) {
        options.sizing = SizingKind::given;
        for (const geom::Vec3& p : mesh.vertices()) options.rho.push_back(2 + p.x());
      }
      const RemeshResult result = remesh(mesh, options);
      CHECK(result.feature_edges > 60);
      CHECK(result.broken_feature_edges == 0);
      CHECK(geom::topology(result.mesh).manifold());
    }
}
