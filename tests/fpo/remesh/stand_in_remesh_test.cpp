// Remeshes that are brought from one surface to another.

#include "fpo/remesh/stand_in_remesh.h"

#include <algorithm>
#include <array>
#include <string>

#include "doctest.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/coarse_start.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/barycentric.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

namespace {

using geom::TriMesh;
using geom::Vec3;

fpo::RemeshOptions options_for(std::size_t n) {
  fpo::RemeshOptions options = fpo::default_options(n, fpo::SizingKind::uniform);
  options.optimize.max_iterations = 5;
  return options;
}

}  // namespace

TEST_CASE("brought to another surface, a remesh has its samples there, its type, and measures of its own") {
  const TriMesh sphere = geom::make_shape("sphere", 8);
  const TriMesh egg = geom::mapped(sphere, [](const Vec3& p) { return Vec3(p.x(), p.y(), 1.5 * p.z()); });
  const fpo::RemeshOptions options = options_for(100);
  fpo::RemeshResult result = fpo::remesh(sphere, options);
  const std::vector<Vec3> weights = fpo::barycentric_coordinates(sphere, result.samples);
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    fpo::SurfaceSample& x = result.samples[i];
    x.position = Vec3(0, 0, 0);
    for (int k = 0; k < 3; ++k) x.position += weights[i][k] * egg.corner(x.facet, k);
  }
  const double before = result.measures.mean_edge;
  const fpo::RemeshResult there = fpo::with_mesh_on(egg, std::move(result), options);
  for (std::size_t i = 0; i < there.samples.size(); ++i)
    CHECK(there.mesh.vertices()[geom::VertexId(i)] == there.samples[i].position);
  const geom::Topology t = geom::topology(there.mesh);
  CHECK(t.manifold());
  CHECK(t.euler == 2);
  const fpo::FinalMeasures again =
      fpo::final_measures(there.mesh, there.wanted, 0, fpo::AngleOptions(options.angles));
  CHECK(there.measures.theta_min == again.theta_min);
  CHECK(there.measures.mean_edge == again.mean_edge);
  CHECK(there.measures.mean_edge > 1.05 * before);
}

TEST_CASE("coarser for all: dense and thin, it has the type of the input and samples on it, as without") {
  for (const auto& [name, size, n] : {std::tuple("plate", 60, 200UL), std::tuple("narrow-torus", 80, 60UL),
                                      std::tuple("paper", 60, 100UL)}) {
    CAPTURE(std::string(name));
    const TriMesh mesh = geom::make_shape(name, size);
    REQUIRE(mesh.num_facets() >= 45 * n);
    fpo::RemeshOptions options = options_for(n);
    options.optimize.max_iterations = 30;
    options.features.reset();
    const fpo::RemeshResult with = fpo::remesh(mesh, options);
    CHECK(with.stood_in);
    CHECK(with.made_coarser);
    CHECK(2 * with.coarse_facets <= mesh.num_facets());
    options.coarse_start = false;
    const fpo::RemeshResult without = fpo::remesh(mesh, options);
    CHECK(!without.stood_in);
    const geom::Topology wanted = geom::topology(mesh), t = geom::topology(with.mesh);
    CHECK(with.type.ok());
    CHECK(t.manifold());
    CHECK(t.euler == wanted.euler);
    CHECK(t.boundary_loops == wanted.boundary_loops);
    CHECK(with.mesh.num_vertices() == n);
    CHECK(with.measures.theta_min > std::min(30.0, without.measures.theta_min - 3));
    for (std::size_t i = 0; i < n; ++i) {
      const fpo::SurfaceSample& x = with.samples[i];
      CHECK(with.mesh.position(geom::VertexId(i)) == x.position);
      CHECK(geom::closest_point(x.position,
                                {mesh.corner(x.facet, 0), mesh.corner(x.facet, 1), mesh.corner(x.facet, 2)})
                .distance2 < 1e-24);
    }
  }
}

TEST_CASE("coarser for all: not where creases are kept, samples are many, or nothing is thin") {
  fpo::RemeshOptions options = options_for(200);
  options.features.reset();
  const TriMesh plate = geom::make_shape("plate", 60);
  CHECK(fpo::may_be_coarser(plate, {}, options));
  CHECK(!fpo::may_be_coarser(plate, fpo::find_features(plate), options));
  CHECK(!fpo::may_be_coarser(plate, {}, options_for(plate.num_facets() / 45 + 1)));
  const std::array<void (*)(fpo::RemeshOptions&), 4> changes = {
      [](fpo::RemeshOptions& o) { o.fixed = {Vec3(0, 0, 0)}; },
      [](fpo::RemeshOptions& o) { o.coarse_start = false; },
      [](fpo::RemeshOptions& o) { o.method = fpo::Method::cvt; },
      [](fpo::RemeshOptions& o) { o.mend = false; }};
  for (const auto change : changes) {
    fpo::RemeshOptions other = options;
    change(other);
    CHECK(!fpo::may_be_coarser(plate, {}, other));
  }
  const TriMesh blob = geom::make_shape("blob", 40);
  REQUIRE(blob.num_facets() >= 45 * options.num_samples);
  CHECK(!fpo::remesh(blob, options).stood_in);
}

TEST_CASE("coarser for all: finer than for the iterations, of the same type") {
  const TriMesh mesh = geom::make_shape("double-torus", 80);
  const std::size_t n = mesh.num_facets() / 100;
  const fpo::Sizing even = fpo::Sizing::uniform(fpo::hexagonal_spacing(mesh.area(), n));
  const auto coarse = fpo::coarse_surface_for_all(mesh, even, n);
  const auto coarser = fpo::coarse_surface(mesh, even, n);
  REQUIRE(coarse);
  REQUIRE(coarser);
  CHECK(3 * coarse->num_facets() > 4 * coarser->num_facets());
  const geom::Topology t = geom::topology(*coarse);
  CHECK(t.manifold());
  CHECK(t.euler == geom::topology(mesh).euler);
  CHECK(!fpo::coarse_surface_for_all(mesh, even, mesh.num_facets() / 45 + 1));
}

TEST_CASE("coarser for all: creases that spoil the first attempt are dropped at once, those asked for kept") {
  const TriMesh star = geom::make_shape("star", 12);
  fpo::RemeshOptions options = options_for(60);
  REQUIRE(star.num_facets() >= 45 * options.num_samples);
  options.optimize.max_iterations = 30;
  options.features = fpo::automatic_features();
  const fpo::RemeshResult dropped = fpo::remesh(star, options);
  CHECK(dropped.stood_in);
  CHECK(dropped.type.ok());
  CHECK(dropped.crease_curves == 0);
  CHECK(!dropped.given_up.empty());
  CHECK(dropped.measures.theta_min > 30);
  options.features = fpo::FeatureOptions();
  const fpo::RemeshResult kept = fpo::remesh(star, options);
  CHECK(!kept.stood_in);
  CHECK(kept.crease_curves > 0);
}

TEST_CASE("coarser for all: where that has small angles, the remesh of the input is taken if it is better") {
  for (const auto& [name, size, n] :
       {std::tuple("narrow-torus", 120, 200UL), std::tuple("dumbbell", 60, 200UL)}) {
    const std::string shape(name);
    CAPTURE(shape);
    const TriMesh mesh = geom::make_shape(name, size);
    fpo::RemeshOptions options = options_for(n);
    options.optimize.max_iterations = 30;
    options.features.reset();
    REQUIRE(fpo::may_be_coarser(mesh, {}, options));
    const fpo::RemeshResult best = fpo::remesh(mesh, options);
    options.coarse_for_all = false;
    CHECK(!fpo::may_be_coarser(mesh, {}, options));
    const fpo::RemeshResult itself = fpo::remesh(mesh, options);
    CHECK(!itself.stood_in);
    CHECK(best.type.ok());
    CHECK((fpo::has_wanted_angles(best) || !fpo::is_better(itself, best)));
    MESSAGE(shape, ": ", best.measures.theta_min, " degrees, edges of at most ", best.measures.greatest_edge,
            std::string(best.made_coarser ? " (coarser)" : ""), "; on the input ", itself.measures.theta_min,
            ", ", itself.measures.greatest_edge);
  }
}
