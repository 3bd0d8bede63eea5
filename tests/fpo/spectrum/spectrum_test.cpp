// The spectrum against its own definition, then against sets whose spectrum is known: white noise is flat on
// every domain, a lattice has its peaks, optimized samples have the plain periodogram's curve on the torus
// and the torus's on other domains.

#include "fpo/spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "doctest.h"
#include "fpo/spectrum/periodogram.h"
#include "fpo/spectrum/spectrum_set.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sample_sets.h"

using fixtures::Points2;
using fixtures::Points3;
using fpo::PowerSpectrum;
using fpo::RadialCurve;
using fpo::SpacingRule;
using fpo::SpectrumOptions;
using fpo::SpectrumSet;
using geom::Vec2;

namespace {

/// Small, for the sake of time: the paper's figures want radius 12.
const SpectrumOptions small{.radius = 5, .max_frequency = 2.5, .threads = 1};

PowerSpectrum in_square(const Points2& points, bool periodic, SpacingRule rule,
                        const SpectrumOptions& o = small) {
  return fpo::differential_spectrum(
      fpo::plane_set(points, {.size = {1, 1}, .periodic = periodic}, rule, o.radius), o);
}

PowerSpectrum on_surface(const Points3& points, const fpo::SpectrumSurface& surface) {
  return fpo::differential_spectrum(fpo::surface_set(points, surface, SpacingRule::uniform), small);
}

PowerSpectrum mean_over_sets(std::uint64_t count, const std::function<PowerSpectrum(std::uint64_t)>& make) {
  std::vector<PowerSpectrum> spectra;
  for (std::uint64_t seed = 1; seed <= count; ++seed) spectra.push_back(make(seed));
  return fpo::mean_spectrum(spectra);
}

RadialCurve curve_of(const PowerSpectrum& s, const SpectrumOptions& o = small) {
  return fpo::radial_curve(s, fpo::ring_width(o));
}

/// The mean of value(k) over the rings k with frequencies in [low, high].
double ring_mean(const RadialCurve& c, double low, double high,
                 const std::function<double(std::size_t)>& value) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < c.frequency.size(); ++k) {
    if (c.frequency[k] < low || c.frequency[k] > high) continue;
    sum += value(k);
    count += 1;
  }
  REQUIRE(count > 0);
  return sum / count;
}

double mean_power(const RadialCurve& c, double low, double high) {
  return ring_mean(c, low, high, [&](std::size_t k) { return c.mean[k]; });
}

/// Over the rings that both curves have.
double rms_difference(const RadialCurve& a, const RadialCurve& b, double low, double high) {
  double sum = 0, count = 0;
  for (std::size_t k = 0, l = 0; k < a.frequency.size(); ++k) {
    if (a.frequency[k] < low || a.frequency[k] > high) continue;
    while (l < b.frequency.size() && b.frequency[l] < a.frequency[k] - 1e-9) ++l;
    if (l == b.frequency.size() || b.frequency[l] > a.frequency[k] + 1e-9) continue;
    sum += std::pow(a.mean[k] - b.mean[l], 2);
    count += 1;
  }
  REQUIRE(count > 10);
  return std::sqrt(sum / count);
}

/// A periodogram's curve in the rings of `o`.
PowerSpectrum plain(const Points2& points, const SpectrumOptions& o) {
  return fpo::periodogram(fixtures::positions(points), geom::FlatTorus({1, 1}), o.max_frequency, 1);
}

/// White noise has P = 1 everywhere. With 6 sets of 300 samples chance alone makes the means over the bands
/// [0, .3] and [0, .5] vary by about .06 and .04 (.02 measured on surfaces, where frames are turned).
void check_flat(const PowerSpectrum& mean_of_sets) {
  const RadialCurve c = curve_of(mean_of_sets);
  CHECK(std::abs(mean_power(c, 0, 0.3) - 1) < 0.2);
  CHECK(std::abs(mean_power(c, 0, 0.5) - 1) < 0.15);
  CHECK(std::abs(mean_power(c, 0.5, 1.2) - 1) < 0.06);
  CHECK(std::abs(mean_power(c, 1.2, 2.5) - 1) < 0.04);
  for (std::size_t k = 0; k < c.mean.size(); ++k) CHECK(std::abs(c.mean[k] - 1) < 0.4);
}

}  // namespace

TEST_CASE("differential_spectrum: on the torus it is the sum over pairs that it says") {
  const Points2 points = fixtures::random_in_square(50, 1);
  const SpectrumOptions o{.radius = 3, .max_frequency = 1.5, .threads = 1};
  const PowerSpectrum s = in_square(points, true, SpacingRule::uniform, o);
  const double r = std::sqrt(2 / std::numbers::sqrt3 / 50), pi = std::numbers::pi;
  double squares = 0;
  for (int j = 0; j <= s.half_y; ++j) {
    for (int i = -s.half_x; i <= s.half_x; ++i) {
      const Vec2 f(i * s.step.x(), j * s.step.y());
      double sum = 0;
      squares = 0;
      for (std::size_t a = 0; a < points.size(); ++a) {
        for (std::size_t b = 0; b < points.size(); ++b) {
          for (int u = -1; u <= 1; ++u) {
            for (int v = -1; v <= 1; ++v) {
              const Vec2 d = (points[b].position - points[a].position + Vec2(u, v)) / r;
              if ((a == b && u == 0 && v == 0) || d.norm() >= 3) continue;
              const double w = std::pow(std::cos(pi * d.norm() / 6), 2);
              sum += w * std::cos(2 * pi * f.dot(d));
              squares += w * w;
            }
          }
        }
      }
      double expected = 0;  // Simpson's rule
      for (int k = 0; k <= 400; ++k) {
        const double x = 3 * k / 400.0;
        expected += (k % 2 == 1 ? 4 : 2) * std::pow(std::cos(pi * x / 6), 2) *
                    std::cyl_bessel_j(0, 2 * pi * f.norm() * x) * 2 * pi * x * 3 / 1200;
      }
      expected *= 2 / std::numbers::sqrt3;
      const double with = 1 + sum / 50 - expected, without = 1 + sum / 50;
      if (f.norm() <= fpo::background_full)
        REQUIRE(s.at(i, j) == doctest::Approx(with).epsilon(5e-3).scale(1));
      if (f.norm() >= fpo::background_none)
        REQUIRE(s.at(i, j) == doctest::Approx(without).epsilon(5e-3).scale(1));
      REQUIRE(s.at(i, j) == s.at(-i, -j));
    }
  }
  CHECK(s.smoothing == doctest::Approx(50 * 50 / squares));
}

TEST_CASE("differential_spectrum: moving and turning samples on the torus moves nothing and turns") {
  Points2 points = fixtures::random_in_square(120, 2);
  const PowerSpectrum s = in_square(points, true, SpacingRule::uniform);
  for (auto& p : points) p.position = Vec2(0.3 - p.position.y(), p.position.x() + 0.9);
  const PowerSpectrum turned = in_square(points, true, SpacingRule::uniform);
  for (int j = -s.half_y; j <= s.half_y; ++j)
    for (int i = -s.half_x; i <= s.half_x; ++i)
      REQUIRE(turned.at(-j, i) == doctest::Approx(s.at(i, j)).epsilon(1e-2).scale(1));
}

TEST_CASE("differential_spectrum: any number of threads gives the same bytes") {
  const Points2 flat = fixtures::random_in_square(150, 3);
  const geom::TriMesh mesh = geom::make_shape("blob", 6);
  const SpectrumSet sets[] = {
      fpo::plane_set(flat, {}, SpacingRule::uniform, 4), fpo::plane_set(flat, {}, SpacingRule::local, 4),
      fpo::surface_set(fixtures::random_on(mesh, 150, 1), fpo::SpectrumSurface(mesh), SpacingRule::uniform)};
  for (const SpectrumSet& set : sets) {
    const auto power = [&](int threads) {
      return fpo::differential_spectrum(set, {.radius = 4, .max_frequency = 2, .threads = threads}).power;
    };
    const std::vector<double> one = power(1);
    for (const int threads : {2, 3, 16}) CHECK(power(threads) == one);
  }
}

TEST_CASE("differential_spectrum: tells how much is done, and ends near all of it") {
  const geom::TriMesh mesh = geom::make_shape("blob", 6);
  const SpectrumSet set =
      fpo::surface_set(fixtures::random_on(mesh, 600, 1), fpo::SpectrumSurface(mesh), SpacingRule::uniform);
  std::vector<double> shares;
  const auto power = [&](const std::function<void(double)>& tell) {
    return fpo::differential_spectrum(set,
                                      {.radius = 4, .max_frequency = 2, .threads = 2, .on_progress = tell})
        .power;
  };
  const std::vector<double> told = power([&](double share) { shares.push_back(share); });
  REQUIRE(shares.size() > 10);
  CHECK(std::ranges::is_sorted(shares));
  CHECK(shares.back() > 0.8);
  CHECK(shares.back() <= 1);
  CHECK(told == power({}));
}

TEST_CASE("differential_spectrum: white noise is flat in the plane") {
  const auto noise = [](bool periodic, SpacingRule rule) {
    return mean_over_sets(6, [&](std::uint64_t seed) {
      return in_square(fixtures::random_in_square(300, seed), periodic, rule);
    });
  };
  SUBCASE("torus") { check_flat(noise(true, SpacingRule::uniform)); }
  SUBCASE("square with border") { check_flat(noise(false, SpacingRule::uniform)); }
  SUBCASE("adaptive torus") {
    check_flat(mean_over_sets(6, [](std::uint64_t seed) {
      return in_square(fixtures::plane_samples("waves5", 600, seed, 0), true, SpacingRule::weights);
    }));
  }
}

TEST_CASE("differential_spectrum: white noise is flat on surfaces") {
  const auto noise = [](const char* name, int size) {
    const geom::TriMesh mesh = geom::make_shape(name, size);
    const fpo::SpectrumSurface surface(mesh);
    return mean_over_sets(
        6, [&](std::uint64_t seed) { return on_surface(fixtures::random_on(mesh, 300, seed), surface); });
  };
  SUBCASE("sphere") { check_flat(noise("sphere", 8)); }
  SUBCASE("cube") { check_flat(noise("cube", 1)); }
  SUBCASE("torus") { check_flat(noise("torus", 24)); }
}

TEST_CASE("differential_spectrum: one set of white noise has anisotropy 0 dB, M averaged ones -10 log10 M") {
  for (const std::uint64_t sets : {1u, 8u}) {
    const RadialCurve c = curve_of(mean_over_sets(sets, [](std::uint64_t seed) {
      return in_square(fixtures::random_in_square(400, seed), true, SpacingRule::uniform);
    }));
    const double mean = ring_mean(c, 0.3, 2.5, [&](std::size_t k) { return c.anisotropy[k]; });
    CHECK(std::abs(fpo::decibel(mean * static_cast<double>(sets))) < 1);
  }
}

TEST_CASE("differential_spectrum: a hexagonal lattice has peaks at 2 / sqrt 3, 2, 4 / sqrt 3 and none else") {
  const fixtures::Lattice lattice(26, 30);
  const SpectrumOptions o{.radius = 12, .max_frequency = 2.5, .threads = 1};
  const PowerSpectrum s =
      fpo::differential_spectrum(fpo::plane_set(lattice.points, {.size = lattice.period, .periodic = true},
                                                SpacingRule::uniform, o.radius),
                                 o);
  double highest = 0;
  for (const double p : s.power) highest = std::max(highest, p);
  int peaks = 0;
  for (int j = -s.half_y + 1; j < s.half_y; ++j) {
    for (int i = -s.half_x + 1; i < s.half_x; ++i) {
      const double f = std::hypot(i, j) * s.step.x(), p = s.at(i, j);
      bool peak = p > 0.3 * highest && f < 2.5;
      for (const auto& [a, b] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
        peak &= p > s.at(i + a, j + b) && p >= s.at(i - a, j - b);
      if (!peak) continue;
      ++peaks;
      CHECK(std::min({std::abs(f - 2 / std::sqrt(3)), std::abs(f - 2), std::abs(f - 4 / std::sqrt(3))}) <
            s.step.x());
    }
  }
  CHECK(peaks == 18);
  // A lattice spikes: far from isotropic.
  const RadialCurve c = curve_of(s, o);
  CHECK(fpo::decibel(*std::max_element(c.anisotropy.begin(), c.anisotropy.end())) > 10);
}

TEST_CASE("differential_spectrum: optimized samples on the torus have the periodogram's curve") {
  const SpectrumOptions o{.radius = 12, .max_frequency = 3, .threads = 1};
  std::vector<PowerSpectrum> direct;
  const PowerSpectrum s = mean_over_sets(4, [&](std::uint64_t seed) {
    const Points2 points = fixtures::plane_samples("uniform", 1024, seed, 60);
    direct.push_back(plain(points, o));
    return in_square(points, true, SpacingRule::uniform, o);
  });
  const RadialCurve c = curve_of(s, o), p = curve_of(fpo::mean_spectrum(direct), o);
  CHECK(rms_difference(c, p, 0, 3) <= 0.05);
  // Farthest point optimization's curve.
  for (std::size_t k = 0; k < c.mean.size() && c.frequency[k] <= 0.5; ++k) CHECK(c.mean[k] < 0.03);
  CHECK(mean_power(c, 0.77, 0.83) == doctest::Approx(0.11).epsilon(0.2));
  CHECK(mean_power(c, 1.16, 1.21) == doctest::Approx(3.4).epsilon(0.1));
  CHECK(mean_power(c, 1.57, 1.67) == doctest::Approx(0.38).epsilon(0.1));
  CHECK(mean_power(c, 2.27, 2.33) == doctest::Approx(2.2).epsilon(0.1));
}

TEST_CASE("differential_spectrum: optimized samples have one curve on torus, adaptive torus and sphere") {
  const auto torus = [](const char* sizing, SpacingRule rule) {
    return curve_of(mean_over_sets(2, [&](std::uint64_t seed) {
      return in_square(fixtures::plane_samples(sizing, 700, seed, 30), true, rule);
    }));
  };
  const RadialCurve uniform = torus("uniform", SpacingRule::uniform);
  CHECK(rms_difference(torus("waves5", SpacingRule::weights), uniform, 0.3, 2.5) < 0.12);
  const geom::TriMesh mesh = geom::make_shape("sphere", 16);
  const fpo::SpectrumSurface surface(mesh);
  const RadialCurve sphere = curve_of(mean_over_sets(
      2, [&](std::uint64_t seed) { return on_surface(fixtures::remeshed(mesh, 500, seed, 20), surface); }));
  CHECK(rms_difference(sphere, uniform, 0, 2.5) < 0.12);
  CHECK(mean_power(sphere, 0, 0.5) < 0.03);
}

TEST_CASE("differential_spectrum: a flat meshed square is a square of the plane with a border") {
  const geom::TriMesh mesh = geom::make_shape("square");
  const fpo::SpectrumSurface surface(mesh);
  for (const bool optimized : {false, true}) {
    const Points3 points =
        optimized ? fixtures::remeshed(mesh, 500, 1, 10) : fixtures::random_on(mesh, 500, 1);
    Points2 flat;
    for (const auto& p : points) flat.push_back({p.position.head<2>(), 0});
    const RadialCurve on_mesh = curve_of(on_surface(points, surface));
    const RadialCurve in_plane = curve_of(in_square(flat, false, SpacingRule::uniform));
    CHECK(rms_difference(on_mesh, in_plane, 0, 2.5) < 0.02);
    CHECK(rms_difference(on_mesh, in_plane, 1.1, 2.5) < 1e-9);
  }
}

TEST_CASE("differential_spectrum: too few samples, radius or frequency out of range") {
  SpectrumSet set = fpo::plane_set(fixtures::random_in_square(20, 1), {}, SpacingRule::uniform, 3);
  CHECK_THROWS_AS(fpo::differential_spectrum(set, {.radius = 1}), geom::InputError);
  CHECK_THROWS_AS(fpo::differential_spectrum(set, {.radius = std::nan("")}), geom::InputError);
  CHECK_THROWS_AS(fpo::differential_spectrum(set, {.radius = 1e9}), geom::InputError);
  CHECK_THROWS_AS(fpo::differential_spectrum(set, {.radius = 3, .max_frequency = 0.1}), geom::InputError);
  CHECK_THROWS_AS(fpo::differential_spectrum(set, {.radius = 3, .max_frequency = 1e9}), geom::InputError);
  set.samples.resize(1);
  CHECK_THROWS_AS(fpo::differential_spectrum(set, {.radius = 3}), geom::InputError);
}
