#include "fpo/plane/plane_angles.h"

#include <cmath>
#include <memory>
#include <string>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/plane/plane_quality.h"

using fpo::PlaneDomain;
using fpo::SiteId;

namespace {

struct Setting {
  Setting(const std::string& name, std::size_t n, int iterations)
      : torus({1, 1}),
        sizing(fpo::named_sizing(name, torus)),
        density(*sizing, torus),
        domain(torus, *sizing, density.edge_length_scale(n),
               fpo::initial_plane_samples(density, n, 1, fpo::PlaneStart::stratified)) {
    fpo::OptimizeOptions options;
    options.max_iterations = iterations;
    options.scope = fpo::Scope::two_ring;
    fpo::optimize(domain, options);
  }
  geom::FlatTorus torus;
  std::unique_ptr<fpo::PlaneSizing> sizing;
  fpo::PlaneDensity density;
  PlaneDomain domain;
};

}  // namespace

TEST_CASE("plane angles: small angles go, the grading, the samples' number and their spacing stay") {
  for (const std::string name : {"waves5", "spot11"}) {
    CAPTURE(name);
    Setting s(name, 2000, 15), t(name, 2000, 15);
    const fpo::PlaneQuality before = fpo::plane_quality(s.domain);
    fpo::PlaneAngleOptions options;
    options.smallest = before.min_angle + 1;
    const fpo::PlaneAngleResult result = fpo::optimize_angles(s.domain, options);
    s.domain.check();
    const fpo::PlaneQuality after = fpo::plane_quality(s.domain);
    CHECK(result.bad_before > 0);
    CHECK(result.bad_after < result.bad_before);
    CHECK((result.bad_after == 0) == (after.min_angle >= options.smallest));
    CHECK(after.min_angle >= before.min_angle);
    CHECK(after.hidden == 0);
    CHECK(after.delta >= 0.7);
    CHECK(std::abs(after.grading_slope - before.grading_slope) < 0.01);
    for (std::size_t i = 0; i < 2000; ++i) {
      // A smaller weight is known as such, so that the wanted length is still that of the sizing.
      const SiteId x(i);
      const auto p = s.domain.triangulation().point(x);
      CHECK(s.domain.edge_length(x) == doctest::Approx(s.domain.edge_length(p.position)).epsilon(1e-9));
    }
    // The same again gives the same.
    fpo::optimize_angles(t.domain, options);
    for (std::size_t i = 0; i < 2000; ++i)
      REQUIRE(t.domain.triangulation().point(SiteId(i)).position ==
              s.domain.triangulation().point(SiteId(i)).position);
  }
}

TEST_CASE("plane angles: uniform samples keep their smallest distance, good ones their places") {
  Setting s("uniform", 1000, 5);
  const double delta = fpo::measure(s.domain).delta;
  fpo::PlaneAngleOptions options;
  options.smallest = 20;  // fewer than any
  CHECK(fpo::optimize_angles(s.domain, options).tried == 0);
  options.smallest = 33;
  const auto result = fpo::optimize_angles(s.domain, options);
  CHECK(result.bad_after <= result.bad_before);
  CHECK(fpo::measure(s.domain).delta >= delta);
}
