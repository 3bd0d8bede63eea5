// The flat torus under Algorithm 1: every query against search in all samples.

#include "fpo/plane/plane_domain.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/plane/plane_quality.h"
#include "fpo/shortest_edge.h"
#include "geom/check.h"

using fpo::Circle;
using fpo::PlaneDensity;
using fpo::PlaneDomain;
using fpo::PlaneSample;
using fpo::Scope;
using fpo::SiteId;
using geom::FlatTorus;
using geom::Regular2;
using geom::Rng;
using geom::SimplexId;
using geom::Vec2;
using geom::WeightedPoint2;

namespace {

/// A sizing, its samples and the domain that refers to them.
struct PlaneDomainSetting {
  PlaneDomainSetting(const std::string& name, std::size_t n, Vec2 period = {1, 1}, std::uint64_t seed = 1)
      : torus(period),
        sizing(fpo::named_sizing(name, torus)),
        density(*sizing, torus),
        domain(torus, *sizing, density.edge_length_scale(n), fpo::initial_plane_samples(density, n, seed)) {}

  FlatTorus torus;
  std::unique_ptr<fpo::PlaneSizing> sizing;
  PlaneDensity density;
  PlaneDomain domain;
};

/// min over all samples but one of |x - p_j|^2 - w_j.
double least_power(const PlaneDomain& domain, const Vec2& x, SiteId but) {
  double least = INFINITY;
  for (std::size_t j = 0; j < domain.num_samples(); ++j) {
    if (SiteId(j) == but) continue;
    const WeightedPoint2 p = domain.triangulation().point(SiteId(j));
    least = std::min(least, domain.torus().shortest(x - p.position).squaredNorm() - p.weight);
  }
  return least;
}

std::vector<Regular2::Triangle> sorted_triangles(const Regular2& t) {
  auto all = t.triangles();
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

TEST_CASE("plane domain: each step of a move against search in all samples") {
  for (const std::string& name : fpo::sizing_names()) {
    CAPTURE(name);
    PlaneDomainSetting s(name, 600, {1.5, 1});
    PlaneDomain& d = s.domain;
    Rng rng(5);
    for (int move = 0; move < 60; ++move) {
      CAPTURE(move);
      const SiteId x(static_cast<std::size_t>(rng.below(600)));
      const WeightedPoint2 before = d.triangulation().point(x);
      REQUIRE(d.separation(x) == least_power(d, before.position, x));
      d.remove(x);
      d.check();
      const Circle local = d.largest_empty(Scope::two_ring);
      const Circle c = d.largest_empty(Scope::global);
      REQUIRE(local.radius2 <= c.radius2);
      for (std::size_t t = 0; t < d.triangulation().simplex_capacity(); ++t)
        if (d.triangulation().is_live(SimplexId(t)))
          REQUIRE(d.triangulation().radius2(SimplexId(t)) <= c.radius2);
      const Vec2 center = d.triangulation().center(SimplexId(c.id.value));
      REQUIRE(std::abs(least_power(d, center, x) - c.radius2) < 1e-12);
      for (int k = 0; k < 20; ++k) {
        const Vec2 anywhere(rng.uniform(0, 1.5), rng.uniform(0, 1));
        REQUIRE(least_power(d, anywhere, x) <= c.radius2 + 1e-12);
      }
      if (move % 3 == 0) {
        d.put_back(x);
        REQUIRE(d.triangulation().point(x).position == before.position);
        REQUIRE(d.triangulation().point(x).weight == before.weight);
      } else {
        d.insert_at(x, move % 3 == 1 ? c : local);
      }
      d.check();
      const Vec2 at = d.triangulation().point(x).position;
      REQUIRE(d.edge_length(x) == doctest::Approx(d.edge_length(at)).epsilon(1e-12));
    }
  }
}

TEST_CASE("plane domain: runs repeat, keep n samples in the input's order, and equal a rebuild") {
  for (const std::string name : {"uniform", "waves5", "spot11"}) {
    for (const Scope scope : {Scope::global, Scope::two_ring}) {
      CAPTURE(name);
      fpo::OptimizeOptions options;
      options.max_iterations = 4;
      options.scope = scope;
      PlaneDomainSetting one(name, 500), two(name, 500);
      const fpo::IterationReport start = fpo::measure(one.domain);
      const auto result = fpo::optimize(one.domain, options);
      fpo::optimize(two.domain, options);
      one.domain.check();
      CHECK(result.last.delta > start.delta);
      CHECK(result.last.mean_delta > 0.85);
      const std::vector<PlaneSample> a = one.domain.samples(), b = two.domain.samples();
      REQUIRE(a.size() == 500);
      std::vector<WeightedPoint2> points(500);
      for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK(a[i].position == b[i].position);
        CHECK(a[i].weight == b[i].weight);
        const SiteId x(i);
        points[i] = one.domain.triangulation().point(x);
        CHECK(a[one.domain.input_index(x)].position == points[i].position);
      }
      const Regular2 rebuilt(one.torus.period(), points);
      CHECK(sorted_triangles(rebuilt) == sorted_triangles(one.domain.triangulation()));
    }
  }
}

TEST_CASE("plane domain: the separation never falls below the largest circle's radius") {
  // With equal weights the minimum distance of the whole set cannot decrease (section 2.1).
  PlaneDomainSetting s("uniform", 300);
  fpo::OptimizeOptions options;
  options.max_iterations = 20;
  double last = 0;
  options.on_iteration = [&](const fpo::IterationReport& r) {
    CHECK(r.delta >= last * (1 - 1e-12));
    CHECK(r.delta <= r.mean_delta);
    last = r.delta;
  };
  fpo::optimize(s.domain, options);
  CHECK(last > 0.88);
}

TEST_CASE("plane domain: farther is what is farther than the separation, by the last bit, twins included") {
  for (const std::string name : {"uniform", "waves5"}) {
    PlaneDomainSetting s(name, 100);
    std::vector<Vec2> places;
    for (const PlaneSample& x : s.domain.samples()) places.push_back(x.position);
    for (std::size_t i = 0; i < 20; ++i) places[i + 20] = places[i];
    PlaneDomain domain(s.torus, *s.sizing, s.density.edge_length_scale(100), places);
    for (SiteId x(0); x.index() < 100; ++x.value) {
      const double separation = domain.separation(x);
      domain.remove(x);
      const Circle top = domain.largest_empty(Scope::global);
      CHECK(domain.is_farther(top, x) == (top.radius2 > separation));
      CHECK(!domain.is_farther({separation, top.id}, x));
      CHECK(domain.is_farther({std::nextafter(separation, INFINITY), top.id}, x));
      domain.put_back(x);
    }
  }
}

TEST_CASE("plane domain: normalized spacing is the distance to the nearest other sample") {
  for (const std::string name : {"uniform", "waves5"}) {
    PlaneDomainSetting s(name, 300, {2, 1});
    fpo::OptimizeOptions options;
    options.max_iterations = 5;
    fpo::optimize(s.domain, options);
    for (std::size_t i = 0; i < 300; ++i) {
      const Vec2 x = s.domain.triangulation().point(SiteId(i)).position;
      double least = INFINITY;
      for (std::size_t j = 0; j < 300; ++j)
        if (j != i) least = std::min(least, s.domain.triangulation().difference(SiteId(i), SiteId(j)).norm());
      CHECK(s.domain.normalized_spacing(SiteId(i)) == doctest::Approx(least / s.domain.edge_length(x)));
    }
  }
}

TEST_CASE("shortest edge removal: fair sets from random ones, by about 0.6 moves a sample") {
  for (const std::string name : {"uniform", "waves5"}) {
    CAPTURE(name);
    PlaneDomainSetting s(name, 1000);
    const fpo::ShortestEdgeResult result = fpo::remove_shortest_edges(s.domain);
    s.domain.check();
    CHECK(result.converged);
    CHECK(result.moves < 1000);
    const fpo::IterationReport report = fpo::measure(s.domain);
    CHECK(report.delta > 0.6);
    CHECK(report.mean_delta > 0.75);
  }
}

TEST_CASE("plane domain: local iterations keep the grading of a stratified start") {
  const FlatTorus torus({1, 1});
  const auto sizing = fpo::named_sizing("waves5", torus);
  const PlaneDensity density(*sizing, torus);
  const auto start = fpo::initial_plane_samples(density, 2000, 1, fpo::PlaneStart::stratified);
  PlaneDomain domain(torus, *sizing, density.edge_length_scale(2000), start);
  fpo::OptimizeOptions options;
  options.max_iterations = 20;
  options.scope = Scope::two_ring;
  fpo::optimize(domain, options);
  const fpo::PlaneQuality quality = fpo::plane_quality(domain);
  CHECK(std::abs(quality.grading_slope - 1) < 0.05);
  CHECK(quality.spacing_variation < 0.04);
  CHECK(quality.hidden == 0);
  CHECK(quality.min_angle > 25);
}

TEST_CASE("plane density: integrals known in closed form, draws that follow the density") {
  const FlatTorus torus({2, 0.5});
  CHECK(PlaneDensity(fpo::UniformSizing(), torus).integral() == 1);
  for (const double ratio : {5.0, 11.0}) {
    const auto band = fpo::named_sizing("band" + std::to_string(static_cast<int>(ratio)), torus);
    const PlaneDensity density(*band, torus);
    // The mean of (a + b cos)^-2 is a (a^2 - b^2)^-3/2.
    const double a = (ratio + 1) / 2, b = (ratio - 1) / 2;
    CHECK(density.integral() == doctest::Approx(a * std::pow(a * a - b * b, -1.5)).epsilon(1e-9));
    // The share of draws in a part of the torus is that part's share of the integral, to 4 sigma.
    const std::size_t n = 20000;
    double expected = 0;
    const auto dense = [&](const Vec2& x) { return band->rho(x) < 2; };
    constexpr int m = 400;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) {
        const Vec2 x(2 * (i + 0.5) / m, 0.5 * (j + 0.5) / m);
        if (dense(x)) expected += 1.0 / (m * m) / (band->rho(x) * band->rho(x));
      }
    expected *= static_cast<double>(n) / density.integral();
    for (const fpo::PlaneStart start : {fpo::PlaneStart::random, fpo::PlaneStart::stratified}) {
      const auto samples = fpo::initial_plane_samples(density, n, 3, start);
      REQUIRE(samples.size() == n);
      const auto found = static_cast<double>(std::count_if(samples.begin(), samples.end(), dense));
      CHECK(std::abs(found - expected) < 4 * std::sqrt(expected));
    }
  }
}

TEST_CASE("plane domain: too few samples or none that fill the torus are refused") {
  using geom::InputError;
  const FlatTorus torus({1, 1});
  const fpo::UniformSizing uniform;
  const PlaneDensity density(uniform, torus);
  CHECK_THROWS_AS(fpo::initial_plane_samples(density, 3, 1), InputError);
  CHECK_THROWS_AS(fpo::initial_plane_samples(density, std::size_t{1} << 40, 1), InputError);
  CHECK_THROWS_AS(PlaneDomain(torus, uniform, 0.1, std::vector<Vec2>(8, {0.5, 0.5})), InputError);
  CHECK_THROWS_AS(PlaneDomain(torus, uniform, 0.1, std::vector<Vec2>(100, {0.5, 0.5})), InputError);
  CHECK_THROWS_AS(PlaneDomain(torus, uniform, 0.1, std::vector<Vec2>(100, {NAN, 0.5})), InputError);
}
