#include "fpo/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fpo/differential_histogram.h"
#include "fpo/spacing_tree.h"
#include "geom/check.h"
#include "geom/parallel.h"

namespace fpo {

using geom::Vec2;

namespace {

/// Samples of one density have so many per unit area, with the spacing as unit of length.
constexpr double hexagonal_density = 2 / std::numbers::sqrt3;
/// Each set is divided among at most so many histograms.
constexpr std::size_t parts = 8;

/// The sums over differentials of part of a set.
struct Sums {
  DifferentialHistogram pairs, background;
  double squares = 0;  ///< of W over the pairs
  explicit Sums(const SpectrumOptions& o)
      : pairs(o.radius, o.max_frequency), background(o.radius, std::min(o.max_frequency, background_none)) {}
  void merge(const Sums& other) {
    pairs.merge(other.pairs);
    background.merge(other.background);
    squares += other.squares;
  }
};

SpacingTree tree_of_targets(const SpectrumSet& set) {
  std::vector<SpectrumPoint> targets = set.samples;
  targets.insert(targets.end(), set.copies.begin(), set.copies.end());
  return SpacingTree(std::move(targets));
}

SpacingTree tree_of_background(const SpectrumSet& set) {
  std::vector<SpectrumPoint> places;
  for (const BackgroundPoint& b : set.background) places.push_back(b.at);
  return SpacingTree(std::move(places));
}

/// Adds what is seen from samples [first, last).
void add_pairs(const SpectrumSet& set, const SpacingTree& targets, double radius,
               std::pair<std::size_t, std::size_t> range, Sums& sums) {
  for (std::size_t i = range.first; i < range.second; ++i) {
    const SpectrumPoint& a = set.samples[i];
    const TangentFrame frame(a.normal);
    targets.each_near(a, radius, [&](std::uint32_t j) {
      if (j == i) return;
      const SpectrumPoint& b = targets.points()[j];
      // Samples at one place (bad, but possible) differ by nothing.
      const bool same_place = (a.position - b.position).squaredNorm() == 0;
      const auto d = same_place ? Vec2(0, 0) : differential(a, frame, b);
      if (!d || !(d->squaredNorm() < radius * radius)) return;
      const double w = spectrum_window(d->norm(), radius);
      sums.pairs.add(*d, w);
      sums.squares += w * w;
    });
  }
}

void add_background(const SpectrumSet& set, const SpacingTree& places, double radius,
                    std::pair<std::size_t, std::size_t> range, Sums& sums) {
  for (std::size_t i = range.first; i < range.second; ++i) {
    const SpectrumPoint& a = set.samples[i];
    const TangentFrame frame(a.normal);
    places.each_near(a, radius, [&](std::uint32_t j) {
      const auto d = differential(a, frame, places.points()[j]);
      if (!d || !(d->squaredNorm() < radius * radius)) return;
      sums.background.add(*d, set.background[j].mass * spectrum_window(d->norm(), radius));
    });
  }
}

/// The plane seen from n samples. The window is smooth, so that a grid as coarse as this integrates it as
/// well as rounding allows.
void add_uniform_background(double n, double radius, Sums& sums) {
  const double cell = 1.0 / 8;
  const int half = static_cast<int>(radius / cell) + 1;
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const Vec2 d(i * cell, j * cell);
      if (d.norm() < radius)
        sums.background.add(d, n * hexagonal_density * cell * cell * spectrum_window(d.norm(), radius));
    }
  }
}

Sums sums_of(const SpectrumSet& set, const SpectrumOptions& o) {
  const std::size_t n = set.samples.size();
  const SpacingTree targets = tree_of_targets(set);
  const std::size_t grain = (n + parts - 1) / parts, ranges = (n + grain - 1) / grain;
  std::vector<Sums> part(ranges, Sums(o));
  geom::parallel_ranges(n, grain, o.threads, [&](std::size_t first, std::size_t last) {
    add_pairs(set, targets, o.radius, {first, last}, part[first / grain]);
  });
  if (set.background.empty()) {
    add_uniform_background(static_cast<double>(n), o.radius, part[0]);
  } else {
    const SpacingTree places = tree_of_background(set);
    geom::parallel_ranges(n, grain, o.threads, [&](std::size_t first, std::size_t last) {
      add_background(set, places, o.radius, {first, last}, part[first / grain]);
    });
  }
  for (std::size_t k = 1; k < part.size(); ++k) part[0].merge(part[k]);
  return std::move(part[0]);
}

/// The share of the background that counts at |f|: 1, then down to 0.
double background_share(double f) {
  const double t = std::clamp((f - background_full) / (background_none - background_full), 0.0, 1.0);
  return 0.5 * (1 + std::cos(std::numbers::pi * t));
}

}  // namespace

double spectrum_window(double r, double radius) {
  if (r >= radius) return 0;
  const double c = std::cos(std::numbers::pi * r / (2 * radius));
  return c * c;
}

double ring_width(const SpectrumOptions& options) { return 1 / (2 * options.radius); }

PowerSpectrum differential_spectrum(const SpectrumSet& set, const SpectrumOptions& o) {
  geom::require(set.samples.size() >= 2, "a spectrum needs two samples at least");
  geom::require(o.radius >= 2 && o.max_frequency >= 0.5,
                "the spectrum's radius or largest frequency is too small");
  const Sums sums = sums_of(set, o);
  const double step = 1 / (4 * o.radius);
  const int half = static_cast<int>(o.max_frequency / step + 1e-9);
  const int low_half = static_cast<int>(std::min(o.max_frequency, background_none) / step + 1e-9);
  const std::vector<double> pairs = sums.pairs.transform(step, half, o.threads);
  const std::vector<double> background = sums.background.transform(step, low_half, o.threads);
  const auto n = static_cast<double>(set.samples.size());
  PowerSpectrum spectrum({step, step}, half, half);
  for (std::size_t k = 0; k < pairs.size(); ++k) spectrum.power[k] = 1 + pairs[k] / n;
  for (int j = -low_half; j <= low_half; ++j)
    for (int i = -low_half; i <= low_half; ++i)
      spectrum.at(i, j) -=
          background_share(step * std::hypot(i, j)) / n *
          background[static_cast<std::size_t>((j + low_half) * (2 * low_half + 1) + i + low_half)];
  spectrum.smoothing = std::max(1.0, n * n / std::max(sums.squares, 1.0));
  return spectrum;
}

}  // namespace fpo
