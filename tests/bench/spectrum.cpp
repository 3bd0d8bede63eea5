// Power spectra (paper, section 6, figures 7 and 8) of sets whose spectrum is known, and of farthest point
// optimization.
//   bench-spectrum             the lattice and the torus only
//   bench-spectrum white       white noise on several domains
//   bench-spectrum lattice     the peaks of a hexagonal lattice
//   bench-spectrum optimized   torus against periodogram, sphere and flat mesh against torus, adaptive sets
//   bench-spectrum MODEL N     8 remeshes with seeds 1 to 8, and white noise there

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "fpo/spectrum/periodogram.h"
#include "fpo/spectrum/spectrum_set.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/sample_sets.h"

namespace {

using fixtures::plane_samples;
using fixtures::Points2;
using fixtures::Points3;
using fixtures::random_in_square;
using fixtures::random_on;
using fixtures::remeshed;
using fpo::PowerSpectrum;
using fpo::SpacingRule;
using geom::Vec2;

const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
const fpo::SpectrumOptions options{.radius = 12, .max_frequency = 3, .threads = threads};
constexpr std::uint64_t num_sets = 8;

PowerSpectrum mean_over_sets(auto&& make) {
  std::vector<PowerSpectrum> spectra;
  for (std::uint64_t seed = 1; seed <= num_sets; ++seed) spectra.push_back(make(seed));
  return fpo::mean_spectrum(spectra);
}

/// The mean of a curve's values with frequencies in [low, high].
double mean_in(const fpo::RadialCurve& c, const std::vector<double>& values, double low, double high) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < c.frequency.size(); ++i) {
    if (c.frequency[i] < low || c.frequency[i] > high || std::isnan(values[i])) continue;
    sum += values[i];
    count += 1;
  }
  return sum / count;
}

/// The extreme value (sign +1: largest) with frequency in [low, high], and where.
void print_extreme(const fpo::RadialCurve& c, double low, double high, double sign) {
  std::size_t best = c.mean.size();
  for (std::size_t i = 0; i < c.frequency.size(); ++i)
    if (c.frequency[i] >= low && c.frequency[i] <= high &&
        (best == c.mean.size() || sign * c.mean[i] > sign * c.mean[best]))
      best = i;
  if (best < c.mean.size()) std::printf("  %5.3f at %4.2f", c.mean[best], c.frequency[best]);
}

fpo::RadialCurve curve_of(const PowerSpectrum& spectrum) {
  return fpo::radial_curve(spectrum, fpo::ring_width(options));
}

void print_header() {
  std::printf("%-34s %s\n", "",
              "largest to .3, to .5     at .8   peak             trough           second peak      dB to .5  "
              "dB .5 on");
}

void print_curve(const char* name, const PowerSpectrum& spectrum) {
  const fpo::RadialCurve c = curve_of(spectrum);
  std::printf("%-34s", name);
  print_extreme(c, 0, 0.3, 1);
  print_extreme(c, 0, 0.5, 1);
  std::printf("  %5.3f", mean_in(c, c.mean, 0.77, 0.83));
  print_extreme(c, 0.9, 1.5, 1);
  print_extreme(c, 1.3, 1.9, -1);
  print_extreme(c, 1.9, 2.6, 1);
  std::printf("  %6.2f  %6.2f\n", fpo::decibel(mean_in(c, c.anisotropy, 0, 0.5)),
              fpo::decibel(mean_in(c, c.anisotropy, 0.5, 3)));
}

/// How far from 1 a flat spectrum's curve is, below and above frequency 1/2.
void print_flatness(const char* name, const PowerSpectrum& spectrum) {
  const fpo::RadialCurve c = curve_of(spectrum);
  std::vector<double> square;
  for (const double p : c.mean) square.push_back((p - 1) * (p - 1));
  std::printf("%-34s  mean to .5 %6.3f  rms off 1 to .5 %.3f, .5 on %.3f  dB %6.2f\n", name,
              mean_in(c, c.mean, 0, 0.5), std::sqrt(mean_in(c, square, 0, 0.5)),
              std::sqrt(mean_in(c, square, 0.5, 3)), fpo::decibel(mean_in(c, c.anisotropy, 0, 3)));
}

/// Over the rings that both curves have.
void print_difference(const char* name, const PowerSpectrum& a, const PowerSpectrum& b, double low,
                      double high) {
  const fpo::RadialCurve x = curve_of(a), y = curve_of(b);
  double sum = 0, count = 0, largest = 0;
  for (std::size_t i = 0, j = 0; i < x.frequency.size(); ++i) {
    if (x.frequency[i] < low || x.frequency[i] > high) continue;
    while (j < y.frequency.size() && y.frequency[j] < x.frequency[i] - 1e-9) ++j;
    if (j == y.frequency.size() || y.frequency[j] > x.frequency[i] + 1e-9) continue;
    const double d = x.mean[i] - y.mean[j];
    sum += d * d;
    count += 1;
    largest = std::max(largest, std::abs(d));
  }
  std::printf("%-34s  rms of the difference over [%.1f, %.1f] %.3f, largest %.3f\n", name, low, high,
              std::sqrt(sum / count), largest);
}

PowerSpectrum in_plane(const Points2& points, bool periodic, SpacingRule rule) {
  const fpo::PlaneRegion region{.size = {1, 1}, .periodic = periodic};
  return fpo::differential_spectrum(fpo::plane_set(points, region, rule, options.radius), options);
}

PowerSpectrum on_surface(const Points3& points, const fpo::SpectrumSurface& surface, SpacingRule rule) {
  return fpo::differential_spectrum(fpo::surface_set(points, surface, rule), options);
}

void white_noise() {
  std::printf("White noise, %d sets of 2000 (expected: 1 and %.2f dB)\n", static_cast<int>(num_sets),
              -fpo::decibel(static_cast<double>(num_sets)));
  const std::size_t n = 2000;
  const auto plane = [&](bool periodic, SpacingRule rule) {
    return mean_over_sets([&](std::uint64_t s) { return in_plane(random_in_square(n, s), periodic, rule); });
  };
  print_flatness("torus, periodogram", mean_over_sets([&](std::uint64_t s) {
                   return fpo::periodogram(fixtures::positions(random_in_square(n, s)),
                                           geom::FlatTorus({1, 1}), options.max_frequency, threads);
                 }));
  print_flatness("torus", plane(true, SpacingRule::uniform));
  print_flatness("square with border", plane(false, SpacingRule::uniform));
  for (const char* name : {"waves5", "spot11"})
    print_flatness((std::string("adaptive torus, ") + name).c_str(), mean_over_sets([&](std::uint64_t s) {
                     return in_plane(plane_samples(name, n, s, 0), true, SpacingRule::weights);
                   }));
  for (const char* name : {"sphere", "cube", "double-torus", "square"}) {
    const geom::TriMesh mesh = geom::make_shape(name);
    const fpo::SpectrumSurface surface(mesh);
    print_flatness(name, mean_over_sets([&](std::uint64_t s) {
                     return on_surface(random_on(mesh, n, s), surface, SpacingRule::uniform);
                   }));
  }
}

/// The frequency of a peak: the mean of the grid's frequencies around the largest power with |f| in
/// [low, high], by power.
double peak_frequency(const PowerSpectrum& s, double low, double high) {
  const auto length = [&](int i, int j) { return std::hypot(i * s.step.x(), j * s.step.y()); };
  int x = 0, y = 0;
  for (int j = 0; j <= s.half_y; ++j)
    for (int i = -s.half_x; i <= s.half_x; ++i)
      if (length(i, j) >= low && length(i, j) <= high && s.at(i, j) > s.at(x, y)) x = i, y = j;
  double sum = 0, power = 0;
  for (int j = y - 2; j <= y + 2; ++j)
    for (int i = x - 2; i <= x + 2; ++i) {
      sum += s.at(i, j) * length(i, j);
      power += s.at(i, j);
    }
  return sum / power;
}

void lattice() {
  const fixtures::Lattice lattice(38, 44);  // nearly as long as high: 44 sqrt(3) / 2 = 38.1
  const PowerSpectrum spectrum =
      fpo::differential_spectrum(fpo::plane_set(lattice.points, {.size = lattice.period, .periodic = true},
                                                SpacingRule::uniform, options.radius),
                                 options);
  std::printf("Hexagonal lattice, peaks (expected: 1.155 2.000 2.309): ");
  for (const double at : {1.155, 2.0, 2.309})
    std::printf("%.3f ", peak_frequency(spectrum, at - .1, at + .1));
  std::printf("\n");
}

/// The reference: the uniform torus, 1024 samples, against the plain periodogram of the same sets.
PowerSpectrum torus() {
  std::vector<PowerSpectrum> plain;
  const PowerSpectrum mean = mean_over_sets([&](std::uint64_t seed) {
    const Points2 points = plane_samples("uniform", 1024, seed, 100);
    // A little more, so that the rings are full up to there.
    plain.push_back(fpo::periodogram(fixtures::positions(points), geom::FlatTorus({1, 1}),
                                     1.05 * options.max_frequency, threads));
    return in_plane(points, true, SpacingRule::uniform);
  });
  std::printf("Farthest point optimization, %d sets\n", static_cast<int>(num_sets));
  print_header();
  print_curve("torus, 1024, periodogram", fpo::mean_spectrum(plain));
  print_curve("torus, 1024", mean);
  print_difference("torus - its periodogram", mean, fpo::mean_spectrum(plain), 0, 3);
  return mean;
}

/// Remeshes of the unit square, on the mesh and in the plane.
void square(const PowerSpectrum& reference) {
  const geom::TriMesh mesh = geom::make_shape("square");
  const fpo::SpectrumSurface surface(mesh);
  std::vector<PowerSpectrum> in_the_plane;
  const PowerSpectrum meshed = mean_over_sets([&](std::uint64_t seed) {
    const Points3 points = remeshed(mesh, 1700, seed);
    Points2 flat;
    for (const auto& p : points) flat.push_back({p.position.head<2>(), 0});
    in_the_plane.push_back(in_plane(flat, false, SpacingRule::uniform));
    return on_surface(points, surface, SpacingRule::uniform);
  });
  const PowerSpectrum plane = fpo::mean_spectrum(in_the_plane);
  print_curve("square with border, 1700, mesh", meshed);
  print_curve("square with border, 1700, plane", plane);
  print_difference("mesh - plane", meshed, plane, 0, 3);
  print_difference("plane - torus", plane, reference, 0, 3);
}

void sphere(const PowerSpectrum& reference) {
  const geom::TriMesh mesh = geom::make_shape("sphere");
  const fpo::SpectrumSurface surface(mesh);
  const PowerSpectrum mean = mean_over_sets([&](std::uint64_t seed) {
    return on_surface(remeshed(mesh, 1700, seed), surface, SpacingRule::uniform);
  });
  print_curve("sphere, 1700", mean);
  print_difference("sphere - torus", mean, reference, 0, 3);
}

void adaptive(const PowerSpectrum& reference) {
  for (const char* name : {"waves5", "spot11"}) {
    for (const SpacingRule rule : {SpacingRule::weights, SpacingRule::local}) {
      const char* by = rule == SpacingRule::weights ? "weights" : "density";
      const PowerSpectrum mean = mean_over_sets(
          [&](std::uint64_t seed) { return in_plane(plane_samples(name, 4096, seed, 60), true, rule); });
      print_curve((std::string(name) + ", 4096, by " + by).c_str(), mean);
      print_difference("  - torus", mean, reference, 0.3, 3);
    }
  }
}

void model(const std::string& path, std::size_t n) {
  const geom::TriMesh mesh = io::read_mesh(path);
  const fpo::SpectrumSurface surface(mesh);
  print_header();
  print_curve((path.substr(path.find_last_of('/') + 1) + ", " + std::to_string(n)).c_str(),
              mean_over_sets([&](std::uint64_t seed) {
                return on_surface(remeshed(mesh, n, seed), surface, SpacingRule::uniform);
              }));
  print_flatness("white noise there", mean_over_sets([&](std::uint64_t seed) {
                   return on_surface(random_on(mesh, n, seed), surface, SpacingRule::uniform);
                 }));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (argc > 2) model(what, std::strtoull(argv[2], nullptr, 10));
  if (what == "white") white_noise();
  if (what == "" || what == "lattice") lattice();
  if (what == "" || what == "optimized") {
    const PowerSpectrum reference = torus();
    if (what == "") return 0;
    sphere(reference);
    square(reference);
    adaptive(reference);
  }
}
