#include "fpo/spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "fpo/spectrum/differential_histogram.h"
#include "fpo/spectrum/spacing_tree.h"
#include "geom/check.h"
#include "geom/parallel.h"

namespace fpo {

using geom::Vec2;

namespace {

/// Samples of one density have so many per unit area, with the spacing as unit of length.
constexpr double hexagonal_density = 2 / std::numbers::sqrt3;
/// Each set is divided among at most so many histograms.
constexpr std::size_t parts = 8;

/// Sums over differentials: between samples, and what is to be subtracted from that.
struct Sums {
  DifferentialHistogram pairs, expected;
  double squares = 0;  ///< of W over the pairs
  explicit Sums(const SpectrumOptions& o)
      : pairs(o.radius, o.max_frequency), expected(o.radius, std::min(o.max_frequency, background_none)) {}
  void merge(const Sums& other) {
    pairs.merge(other.pairs);
    expected.merge(other.expected);
    squares += other.squares;
  }
};

std::vector<SpectrumMass> with_mass(const std::vector<SpectrumPoint>& points) {
  std::vector<SpectrumMass> all;
  all.reserve(points.size());
  for (const SpectrumPoint& p : points) all.push_back({p, 1});
  return all;
}

/// Places to look at, those near each other together.
class Scene {
 public:
  explicit Scene(const std::vector<SpectrumMass>& places) : tree_(points_of(places)) {
    places_.reserve(places.size());
    for (const std::uint32_t j : tree_.order()) places_.push_back(places[j]);
  }

  /// Calls f(j, differential, mass_j W T) for each place within the radius of a.
  template <class F>
  void look(const SpectrumPoint& a, double radius, F&& f) const {
    const TangentFrame frame(a.normal);
    tree_.each_near(a, radius, [&](std::uint32_t k) {
      const SpectrumMass& b = places_[k];
      const auto d = differential(a, frame, b.at);
      if (!d) return;
      const double r2 = d->squaredNorm();
      if (!(r2 < radius * radius)) return;
      const double turn = a.normal.dot(b.at.normal);
      f(tree_.order()[k], *d, b.mass * turn * turn * spectrum_window(std::sqrt(r2), radius));
    });
  }

 private:
  static std::vector<SpectrumPoint> points_of(const std::vector<SpectrumMass>& places) {
    std::vector<SpectrumPoint> points;
    points.reserve(places.size());
    for (const SpectrumMass& p : places) points.push_back(p.at);
    return points;
  }
  SpacingTree tree_;
  std::vector<SpectrumMass> places_;  ///< in the order of the tree
};

/// Tells how much is done, by the number of places that were looked from, each weighted by what it sees.
class Teller {
 public:
  Teller(const SpectrumOptions& o, double all) : tell_(o.on_progress), all_(all) {}
  void add(double work) {
    if (!tell_) return;
    const std::lock_guard lock(access_);
    done_ += work;
    tell_(std::min(1.0, done_ / all_));
  }

 private:
  const std::function<void(double)>& tell_;
  double all_, done_ = 0;
  std::mutex access_;
};

/// What a loop over places is told by.
struct Loop {
  std::size_t count;
  double weight;  ///< of a place: how many pieces and samples it sees for each sample around it
  Teller& teller;
};

/// Calls work(i, sums of i's part) for i in [0, count), and adds what the parts got to `total`.
template <class Work>
void share(const Loop& loop, const SpectrumOptions& o, Sums& total, const Work& work) {
  constexpr std::size_t between = 64;  // places, between two reports
  const std::size_t count = loop.count, grain = (count + parts - 1) / parts;
  std::vector<Sums> part((count + grain - 1) / grain, Sums(o));
  geom::parallel_ranges(count, grain, o.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      work(i, part[first / grain]);
      if (i % between == between - 1) loop.teller.add(static_cast<double>(between) * loop.weight);
    }
  });
  for (const Sums& sums : part) total.merge(sums);
}

/// What is seen from samples and from viewpoints.
void add_domain(const SpectrumSet& set, const Scene& samples, const SpectrumOptions& o, Sums& total,
                Teller& teller) {
  const Scene background(set.background);
  share({set.samples.size(), background_density, teller}, o, total, [&](std::size_t i, Sums& sums) {
    background.look(set.samples[i], o.radius,
                    [&](std::uint32_t, const Vec2& d, double w) { sums.expected.add(d, w); });
  });
  share({set.viewpoints.size(), 1 + background_density, teller}, o, total, [&](std::size_t i, Sums& sums) {
    const double mass = set.viewpoints[i].mass;
    samples.look(set.viewpoints[i].at, o.radius,
                 [&](std::uint32_t, const Vec2& d, double w) { sums.expected.add(d, mass * w); });
    background.look(set.viewpoints[i].at, o.radius,
                    [&](std::uint32_t, const Vec2& d, double w) { sums.expected.add(d, -mass * w); });
  });
}

/// The plane seen from n samples. The window is smooth, so that a grid as coarse as this integrates it as
/// well as rounding allows.
void add_uniform_plane(double n, double radius, Sums& sums) {
  const double cell = 1.0 / 8;
  const int half = static_cast<int>(radius / cell) + 1;
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      const Vec2 d(i * cell, j * cell);
      if (d.norm() < radius)
        sums.expected.add(d, n * hexagonal_density * cell * cell * spectrum_window(d.norm(), radius));
    }
  }
}

Sums sums_of(const SpectrumSet& set, const SpectrumOptions& o) {
  std::vector<SpectrumMass> seen = with_mass(set.samples), copies = with_mass(set.copies);
  seen.insert(seen.end(), copies.begin(), copies.end());
  const Scene samples(seen);
  Sums total(o);
  const auto n = static_cast<double>(set.samples.size()), v = static_cast<double>(set.viewpoints.size());
  Teller teller(o, n + (set.background.empty() ? 0 : n * background_density + v * (1 + background_density)));
  share({set.samples.size(), 1, teller}, o, total, [&](std::size_t i, Sums& sums) {
    samples.look(set.samples[i], o.radius, [&](std::uint32_t j, const Vec2& d, double w) {
      if (j == i) return;
      sums.pairs.add(d, w);
      sums.squares += w * w;
    });
  });
  if (set.background.empty())
    add_uniform_plane(static_cast<double>(set.samples.size()), o.radius, total);
  else
    add_domain(set, samples, o, total, teller);
  return total;
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
  const std::vector<double> expected = sums.expected.transform(step, low_half, o.threads);
  const auto n = static_cast<double>(set.samples.size());
  PowerSpectrum spectrum({step, step}, half, half);
  for (std::size_t k = 0; k < pairs.size(); ++k) spectrum.power[k] = 1 + pairs[k] / n;
  auto to_expect = expected.begin();
  for (int j = -low_half; j <= low_half; ++j)
    for (int i = -low_half; i <= low_half; ++i)
      spectrum.at(i, j) -= background_share(step * std::hypot(i, j)) / n * *to_expect++;
  spectrum.smoothing = std::max(1.0, n * n / std::max(sums.squares, 1.0));
  return spectrum;
}

}  // namespace fpo
