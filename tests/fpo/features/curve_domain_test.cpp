#include "fpo/features/curve_domain.h"

#include <cmath>

#include "doctest.h"
#include "fpo/optimize.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"

using namespace fpo;

namespace {

std::vector<double> random_positions(double length, std::size_t n, std::uint64_t seed) {
  geom::Rng rng(seed);
  std::vector<double> positions;
  for (std::size_t i = 0; i < n; ++i) positions.push_back(length * rng.uniform());
  return positions;
}

/// The gaps of the samples, ends included, the slow way.
std::vector<double> gaps(const CurveDomain& domain, double length, bool loop) {
  std::vector<double> t;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) t.push_back(domain.position(geom::SiteId(i)));
  if (!loop) t.push_back(0), t.push_back(length);
  std::ranges::sort(t);
  if (loop) t.push_back(t.front() + length);
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) result.push_back(t[i + 1] - t[i]);
  return result;
}

}  // namespace

TEST_CASE("curve domain: farthest point optimization ends in even spacing, on intervals and loops") {
  for (const bool loop : {false, true})
    for (const std::size_t n : {1, 2, 3, 7, 20}) {
      CAPTURE(loop);
      CAPTURE(n);
      CurveDomain domain(3, loop, random_positions(3, n, n));
      OptimizeOptions options;
      options.max_iterations = 400;
      options.target_delta = 0.98;
      optimize(domain, options);
      domain.check();
      const double even = 3 / static_cast<double>(n + (loop ? 0 : 1));
      for (const double gap : gaps(domain, 3, loop)) CHECK(gap == doctest::Approx(even).epsilon(0.25));
    }
}

TEST_CASE("curve domain: the largest circle is half the largest gap, through random moves") {
  for (const bool loop : {false, true}) {
    CAPTURE(loop);
    CurveDomain domain(2, loop, random_positions(2, 9, 5));
    geom::Rng rng(8);
    for (int move = 0; move < 200; ++move) {
      const geom::SiteId x(static_cast<std::size_t>(9 * rng.uniform()));
      domain.remove(x);
      const Circle c = domain.largest_empty(Scope::global);
      if (move % 3 == 0)
        domain.put_back(x);
      else
        domain.insert_at(x, c);
      domain.check();
      const double widest = std::ranges::max(gaps(domain, 2, loop));
      CHECK(domain.largest_empty(Scope::global).radius2 == doctest::Approx(widest * widest / 4));
    }
  }
}

TEST_CASE("curve metric: lengths, places and nearest places agree with numeric integration") {
  const geom::TriMesh mesh = geom::make_shape("tube", 20);
  const Features features = find_features(mesh);
  REQUIRE(features.curves.size() == 2);
  VertexField rho;
  for (const geom::Vec3& p : mesh.vertices()) rho.push_back(1.2 + p.x());
  const Sizing sizing = fit_sizing(mesh, rho, 300);
  for (const FeatureCurve& curve : features.curves) {
    const CurveMetric metric(mesh, curve, sizing);
    double sum = 0;
    for (std::size_t i = 0; i < curve.vertices.size(); ++i) {
      const geom::VertexId a = curve.vertices[i], b = curve.vertices[(i + 1) % curve.vertices.size()];
      const double size = (mesh.position(b) - mesh.position(a)).norm();
      constexpr int steps = 200;
      for (int k = 0; k < steps; ++k) {
        const double u = (k + 0.5) / steps;
        sum += size / steps / ((1 - u) * sizing.at(a) + u * sizing.at(b));
      }
    }
    CHECK(metric.length() == doctest::Approx(sum).epsilon(1e-5));
    for (const double share : {0.1, 0.35, 0.8}) {
      const double t = share * metric.length();
      const CurveMetric::Nearest back = metric.nearest(metric.at(t).position);
      CHECK(back.t == doctest::Approx(t));
      CHECK(back.distance2 < 1e-24);
    }
  }
}
