#include "fpo/remesh/fidelity.h"

#include "doctest.h"
#include "fpo/features/curve_slides.h"
#include "fpo/features/feature_samples.h"
#include "fpo/optimize.h"
#include "fpo/remesh/dual.h"
#include "fpo/surface/initial_samples.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

TEST_CASE("fidelity: triangles come no farther from the surface, and the moves are as many as allowed") {
  const geom::TriMesh mesh = fixtures::blob(16);
  constexpr std::size_t n = 150;
  std::vector<std::size_t> tried;
  for (const std::size_t most_moves : {std::size_t{0}, std::size_t{3000}}) {
    SurfaceDomain domain(mesh, random_samples(mesh, n, 4));
    for (std::size_t i = 0; i < 10 * n; ++i) domain.move(SiteId(i % n), Scope::global);
    FidelityOptions options;
    options.most_moves = most_moves;
    const FidelityResult result = improve_fidelity(domain, AngleOptions(), options);
    CHECK(result.largest_before > 0);
    CHECK(result.largest_after <= result.largest_before);
    CHECK(domain.num_samples() == n);
    domain.check();
    tried.push_back(result.tried);
  }
  CHECK(tried[0] <= 1);
  CHECK(tried[1] > tried[0]);
}

TEST_CASE(
    "fidelity: where triangles are farthest from the surface at its border, no sample comes between two "
    "there") {
  for (const int sides : {10, 12, 16, 32}) {
    CAPTURE(sides);
    const geom::TriMesh mesh = geom::make_shape("tube", sides);
    const Features features = find_features(mesh);
    constexpr std::size_t n = 800;
    // Lengths that are about the same everywhere, but not known to be.
    const Sizing sizing(mesh, VertexField(mesh.num_vertices(), hexagonal_spacing(mesh.area(), n)));
    const FeatureSamples on_curves = sample_features(mesh, features, {}, sizing, {n, 1});
    const CurveSlides slides(mesh, features, on_curves, sizing);
    std::vector<SurfaceSample> samples = on_curves.samples;
    for (const SurfaceSample& x : random_samples(mesh, n - samples.size(), 1)) samples.push_back(x);
    SurfaceDomain domain(mesh, sizing, samples, {.num_fixed = on_curves.samples.size()});
    OptimizeOptions optimization;
    optimization.max_iterations = 20;
    optimization.scope = Scope::two_ring;
    optimize(domain, optimization);
    const auto num_joined = [&] {
      std::size_t joined = 0;
      for (std::size_t i = 0; i < on_curves.samples.size(); ++i)
        joined += slides.has_its_edges(domain, SiteId(i));
      return joined;
    };
    const std::size_t before = num_joined();
    CHECK(before > on_curves.samples.size() / 2);
    AngleOptions angles;
    angles.slides = &slides;
    FidelityOptions options;
    options.most_moves = 20000;
    options.share_of_largest = 0.2;
    CHECK(improve_fidelity(domain, angles, options).mended > 0);
    CHECK(num_joined() >= before);
  }
}

TEST_CASE("fidelity: with lengths that differ no sample comes closer than is allowed, if that is asked for") {
  const geom::TriMesh mesh = fixtures::blob(16);
  constexpr std::size_t n = 150;
  constexpr double slope = 0.3;  // a neighbour's length may be greater by so much a distance
  std::size_t mended = 0;
  for (const std::uint64_t seed : {4, 5, 6}) {
    const Sizing sizing = fixtures::graded(mesh, 0.08, slope);
    SurfaceDomain domain(mesh, sizing, random_samples(mesh, sizing, n, seed));
    for (std::size_t i = 0; i < 10 * n; ++i) domain.move(SiteId(i % n), Scope::two_ring);
    const double before = measure(domain).delta;
    FidelityOptions options;
    options.keep_spacing = true;
    mended += improve_fidelity(domain, AngleOptions(), options).mended;
    const double least = std::min(before, options.enough_delta);
    CHECK(measure(domain).delta >= 1 / (1 / least + slope));
    domain.check();
  }
  CHECK(mended > 0);
}
