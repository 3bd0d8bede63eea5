#include "fpo/remesh/lengths.h"

#include <cmath>

#include "doctest.h"
#include "fpo/measure/hausdorff.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/mesh/scaling.h"
#include "geom/shapes/shapes.h"

using geom::TriMesh;

namespace {

double mean_edge(const TriMesh& mesh) {
  double sum = 0, count = 0;  // of a closed mesh each edge is counted twice
  for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      sum += (mesh.corner(t, e) - mesh.corner(t, (e + 1) % 3)).norm();
      ++count;
    }
  return sum / count;
}

fpo::RemeshResult remeshed(const TriMesh& mesh, const fpo::Lengths& lengths) {
  fpo::RemeshOptions options;
  options.limits = {.gradation = 0.12, .smallest = 1e-6, .largest = 1e6};
  fpo::set_number_of_samples(mesh, lengths, options);
  fpo::complete(options, {.iterations = 20});
  return fpo::remesh(mesh, options);
}

}  // namespace

TEST_CASE("lengths: edges are as long as wanted on average, in any units") {
  for (const double unit : {1.0, 1e-90, 1e40}) {
    const TriMesh torus = geom::scaled(geom::make_shape("torus"), unit);
    const double length = 0.04 * torus.diagonal();
    const fpo::RemeshResult result = remeshed(torus, {.edge_length = length, .error = {}, .radius = {}});
    CHECK(mean_edge(geom::scaled(result.mesh, 1 / unit)) ==
          doctest::Approx(0.04 * geom::make_shape("torus").diagonal()).epsilon(0.02));
  }
}

TEST_CASE("lengths: the remesh stays within about the error") {
  const TriMesh sphere = geom::make_shape("sphere");
  for (const double error : {0.02, 0.005}) {
    const fpo::RemeshResult result = remeshed(sphere, {.edge_length = {}, .error = error, .radius = {}});
    const double distance = fpo::surface_distance(result.mesh, sphere).max;
    CHECK(distance < 1.3 * error);
    CHECK(distance > 0.5 * error);  // and is not finer than it need be
  }
}

TEST_CASE("lengths: folds at features bend nothing; a cube's sides are flat") {
  const TriMesh cube = geom::make_shape("cube");
  const fpo::Features features = fpo::find_features(cube, fpo::automatic_features());
  for (const double h : fpo::error_size(cube, features, 1e-4, 0.3)) CHECK(h == doctest::Approx(0.3));
  double least = 1;
  for (const double h : fpo::error_size(cube, {}, 1e-4, 0.3)) least = std::min(least, h);
  CHECK(least < 0.1);
}

TEST_CASE("lengths: given sizes are lengths, and come back") {
  const TriMesh torus = geom::make_shape("torus");
  fpo::RemeshOptions options;
  options.sizing = fpo::SizingKind::given;
  options.limits = {.gradation = 0.12, .smallest = 1e-6, .largest = 1e6};
  options.rho.assign(torus.num_vertices(), 0.2);
  fpo::set_number_of_samples(torus, {}, options);
  fpo::complete(options, {.iterations = 0});
  for (const double h : fpo::remesh(torus, options).sizing) CHECK(h == doctest::Approx(0.2).epsilon(0.01));
}

TEST_CASE("lengths: what makes no sense is refused") {
  const TriMesh torus = geom::make_shape("torus");
  fpo::RemeshOptions options;
  const auto refused = [&](const fpo::Lengths& lengths) {
    fpo::RemeshOptions copy = options;
    CHECK_THROWS_AS(fpo::set_number_of_samples(torus, lengths, copy), geom::InputError);
  };
  refused({});
  refused({.edge_length = 0.0, .error = {}, .radius = {}});
  refused({.edge_length = 1e-7, .error = {}, .radius = {}});
  refused({.edge_length = {}, .error = -1.0, .radius = {}});
  options.sizing = fpo::SizingKind::local_feature_size;
  refused({.edge_length = {}, .error = 0.1, .radius = {}});
}
