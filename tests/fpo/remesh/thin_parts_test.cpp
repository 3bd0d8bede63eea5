#include "fpo/remesh/thin_parts.h"

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/remesh/at_least.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;

namespace {

struct Outcome {
  std::unique_ptr<SurfaceDomain> before, after;
  ThinParts found;
  TypeCheck type;
};

Outcome with_room(const TriMesh& mesh, std::size_t n, int polishing = 5, double polishing_gain = 0) {
  Outcome outcome;
  const auto optimized = [&] {
    auto domain = std::make_unique<SurfaceDomain>(mesh, random_samples(mesh, n, 1));
    OptimizeOptions options;
    options.max_iterations = 10;
    options.order = VisitOrder::in_turn;
    optimize(*domain, options);
    return domain;
  };
  ThinPartOptions options;
  options.polishing = polishing;
  options.polishing_gain = polishing_gain;
  const geom::SurfaceType type = geom::surface_type(mesh);
  outcome.before = optimized();
  outcome.after = make_room_for_thin_parts(optimized(), {}, type, options, outcome.found);
  outcome.type = dual_of(*outcome.after, type, false).type;
  return outcome;
}

}  // namespace

TEST_CASE("thin parts: where nothing is wrong nothing is done") {
  const TriMesh mesh = geom::make_shape("torus", 24);
  const Outcome outcome = with_room(mesh, 150);
  CHECK(outcome.found.places == 0);
  CHECK(outcome.found.faults_before == 0);
  CHECK(outcome.after->sizing().is_uniform());
  for (std::size_t i = 0; i < 150; ++i)
    CHECK(outcome.after->sample(SiteId(i)).position == outcome.before->sample(SiteId(i)).position);
}

TEST_CASE("thin parts: a bar, a handle and a hole much thinner than the spacing are kept") {
  struct Case {
    const char* name;
    std::size_t n;
  };
  for (const Case& c : {Case{"dumbbell", 400}, {"thin-handle", 300}, {"narrow-torus", 300}}) {
    CAPTURE(std::string(c.name));
    const auto& [name, n] = c;
    const TriMesh mesh = geom::make_shape(name, 16);
    const Outcome outcome = with_room(mesh, n);
    CHECK(outcome.found.faults_before > 0);
    CHECK(outcome.found.faults_after == 0);
    CHECK(outcome.found.right_type);
    CHECK(outcome.type.ok());
    CHECK(outcome.found.places > 0);
    CHECK(outcome.found.scale > 1);
    CHECK(outcome.after->num_samples() == n);
    outcome.after->check();
  }
}

TEST_CASE("thin parts: components that get no sample of their own are bodies where n allows it") {
  TriMesh mesh = geom::make_shape("sphere", 8);
  constexpr int bodies = 20;
  for (int k = 0; k < bodies; ++k) {
    const double size = 0.03 + 0.002 * k;  // of a sample's share, or of two
    mesh = geom::joined(mesh,
                        geom::mapped(geom::make_shape("sphere", 4), [&](const geom::Vec3& p) -> geom::Vec3 {
                          return size * p + geom::Vec3(1.5 + 0.3 * (k % 5), 0.3 * (k / 5), 0);
                        }));
  }
  const Outcome outcome = with_room(mesh, 350);
  CHECK(outcome.found.faults_before >= bodies);
  CHECK(outcome.type.ok());
  CHECK(outcome.found.right_type);
  CHECK(outcome.after->num_samples() == 350);
}

TEST_CASE("thin parts: polishing ends after five iterations that gain less than is wanted") {
  const TriMesh mesh = geom::make_shape("thin-handle", 16);
  const Outcome five = with_room(mesh, 300, 5), stopped = with_room(mesh, 300, 40, 1);
  const Outcome all = with_room(mesh, 300, 40, -1);
  std::size_t others = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    CHECK(stopped.after->sample(SiteId(i)).position == five.after->sample(SiteId(i)).position);
    others += all.after->sample(SiteId(i)).position != five.after->sample(SiteId(i)).position;
  }
  CHECK(others > 0);
}

TEST_CASE("thin parts: what there are too few samples for starves nothing else") {
  const TriMesh mesh = geom::make_shape("dumbbell", 16);
  const Outcome outcome = with_room(mesh, 30);
  CHECK(outcome.found.scale <= ThinPartOptions().most_scale);
  CHECK(outcome.found.faults_after <= outcome.found.faults_before);
}

TEST_CASE("thin parts: the pipeline keeps the type with exactly n samples, and says what it did") {
  const TriMesh mesh = geom::make_shape("thin-handle", 24);
  RemeshOptions options = default_options(400, SizingKind::uniform);
  options.optimize.max_iterations = 10;
  options.features.reset();  // in so coarse a mesh all of the handle is creases
  const RemeshResult result = remesh(mesh, options);
  CHECK(result.mesh.num_vertices() == 400);
  CHECK(result.type.ok());
  CHECK(geom::topology(result.mesh).euler == 0);
  CHECK(result.thin_parts.places > 0);
  CHECK(result.measures.theta_min > 30);
  options.mend = false;
  CHECK(!remesh(mesh, options).type.ok());
}

TEST_CASE("thin parts: nothing is moved where it is only looked, and the type is told") {
  const TriMesh mesh = geom::make_shape("dumbbell", 16);
  const geom::SurfaceType type = geom::surface_type(mesh);
  auto domain = std::make_unique<SurfaceDomain>(mesh, random_samples(mesh, 200, 1));
  const std::vector<SurfaceSample> before = samples_of(*domain);
  ThinPartOptions look;
  look.rounds = 0;
  ThinParts found;
  domain = make_room_for_thin_parts(std::move(domain), {}, type, look, found);
  CHECK(found.faults_before > 0);
  CHECK(!found.right_type);
  CHECK(found.places == 0);
  for (std::size_t i = 0; i < before.size(); ++i)
    CHECK(domain->sample(SiteId(i)).position == before[i].position);
}

TEST_CASE("thin parts: lengths that n is too small for are evened out until the type is right") {
  const TriMesh mesh = geom::make_shape("horn", 16);
  int evened = 0;
  for (const std::size_t n : {230, 280, 320}) {  // for which of these it is enough hangs on the samples
    CAPTURE(n);
    RemeshOptions options = default_options(n, SizingKind::local_feature_size);
    options.optimize.max_iterations = 10;
    options.features.reset();
    const RemeshResult result = remesh(mesh, options);
    CHECK(result.mesh.num_vertices() == n);
    if (result.least_length == 0) continue;
    ++evened;
    CHECK(result.type.ok());
    CHECK(result.least_length > options.limits.smallest);
  }
  CHECK(evened > 0);
}

TEST_CASE("at least: as many samples as it takes, and no more where n is enough") {
  RemeshOptions options = default_options(12, SizingKind::uniform);
  options.optimize.max_iterations = 3;
  const TriMesh mesh = geom::make_shape("frame", 2);
  options.features.reset();
  const AtLeastResult found = remesh_at_least(mesh, options);
  CHECK(found.remesh.type.ok());
  if (found.runs > 1) {
    CHECK(found.not_enough >= 12);
    CHECK(found.remesh.mesh.num_vertices() > found.not_enough);
    CHECK(static_cast<double>(found.remesh.mesh.num_vertices()) <=
          1.2 * static_cast<double>(found.not_enough) + 2);
  }
  options.num_samples = 200;
  const AtLeastResult enough = remesh_at_least(mesh, options);
  CHECK(enough.runs == 1);
  CHECK(enough.remesh.mesh.num_vertices() == 200);
  options.num_samples = 2;  // no triangle
  CHECK_THROWS_AS(remesh(mesh, options), geom::InputError);
  const AtLeastResult more = remesh_at_least(mesh, options);
  CHECK(more.remesh.type.ok());
  CHECK(more.not_enough >= 2);
  options.limits.gradation = -1;  // refused whatever n is
  options.sizing = SizingKind::curvature;
  CHECK_THROWS_AS(remesh_at_least(mesh, options), geom::InputError);
}
