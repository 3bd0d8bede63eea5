#include "fpo/plane/plane_sizing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fpo/plane/plane_domain.h"
#include "geom/check.h"
#include "geom/hilbert.h"

namespace fpo {

using geom::FlatTorus;
using geom::Rng;
using geom::Vec2;

namespace {

constexpr std::size_t most_plane_samples = 100'000'000;  // ids and memory: about 200 bytes a sample
constexpr double tau = 2 * std::numbers::pi;

/// (r + 1) / 2 + (r - 1) / 2 sin x sin y, between 1 and r.
class Waves final : public PlaneSizing {
 public:
  Waves(const FlatTorus& torus, double ratio)
      : frequency_(tau * torus.period().cwiseInverse()), ratio_(ratio) {}
  double rho(const Vec2& x) const override {
    const Vec2 angle = x.cwiseProduct(frequency_);
    return (ratio_ + 1) / 2 + (ratio_ - 1) / 2 * std::sin(angle.x()) * std::sin(angle.y());
  }

 private:
  Vec2 frequency_;
  double ratio_;
};

/// One dense spot in the middle: r - (r - 1) (1 - cos x) (1 - cos y) / 4, between 1 and r.
class SpotSizing final : public PlaneSizing {
 public:
  SpotSizing(const FlatTorus& torus, double ratio)
      : frequency_(tau * torus.period().cwiseInverse()), ratio_(ratio) {}
  double rho(const Vec2& x) const override {
    const Vec2 angle = x.cwiseProduct(frequency_);
    return ratio_ - (ratio_ - 1) * (1 - std::cos(angle.x())) * (1 - std::cos(angle.y())) / 4;
  }

 private:
  Vec2 frequency_;
  double ratio_;
};

/// Dense along a diagonal: a function of x + y alone.
class Band final : public PlaneSizing {
 public:
  Band(const FlatTorus& torus, double ratio)
      : frequency_(tau * torus.period().cwiseInverse()), ratio_(ratio) {}
  double rho(const Vec2& x) const override {
    return (ratio_ + 1) / 2 + (ratio_ - 1) / 2 * std::cos(x.dot(frequency_));
  }

 private:
  Vec2 frequency_;
  double ratio_;
};

}  // namespace

std::vector<std::string> sizing_names() {
  return {"uniform", "waves5", "waves11", "spot5", "spot11", "band5", "band11"};
}

std::unique_ptr<PlaneSizing> named_sizing(const std::string& name, const FlatTorus& torus) {
  if (name == "uniform") return std::make_unique<UniformSizing>();
  if (name == "waves5") return std::make_unique<Waves>(torus, 5);
  if (name == "waves11") return std::make_unique<Waves>(torus, 11);
  if (name == "spot5") return std::make_unique<SpotSizing>(torus, 5);
  if (name == "spot11") return std::make_unique<SpotSizing>(torus, 11);
  if (name == "band5") return std::make_unique<Band>(torus, 5);
  if (name == "band11") return std::make_unique<Band>(torus, 11);
  return nullptr;
}

PlaneDensity::PlaneDensity(const PlaneSizing& sizing, const FlatTorus& torus, int resolution) {
  const Vec2& period = torus.period();
  const auto cells_along = [&](double side) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(resolution * side / period.maxCoeff())));
  };
  const std::size_t columns = cells_along(period.x()), rows = cells_along(period.y());
  cell_ = {period.x() / static_cast<double>(columns), period.y() / static_cast<double>(rows)};
  std::vector<Vec2> grid;
  grid.reserve(columns * rows);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i)
      grid.emplace_back(static_cast<double>(i) * cell_.x(), static_cast<double>(j) * cell_.y());
  }
  corner_.reserve(grid.size());
  mass_up_to_.reserve(grid.size());
  double mass = 0;
  for (const std::uint32_t k : geom::hilbert_order(grid, Vec2::Constant(period.maxCoeff()))) {
    const double rho = sizing.rho(grid[k] + cell_ / 2);
    geom::require(rho > 0 && std::isfinite(rho), "the sizing function is not positive everywhere");
    corner_.push_back(grid[k]);
    mass_up_to_.push_back(mass += cell_.x() * cell_.y() / (rho * rho));
  }
  geom::require(mass > 0 && std::isfinite(mass), "the sizing function is too large or too small");
}

double PlaneDensity::edge_length_scale(std::size_t n) const {
  return std::sqrt(2 * integral() / (std::numbers::sqrt3 * static_cast<double>(n)));
}

Vec2 PlaneDensity::draw(double share, Rng& rng) const {
  const auto pick = std::ranges::upper_bound(mass_up_to_, share * integral());
  const auto cell = static_cast<std::size_t>(std::min(pick, mass_up_to_.end() - 1) - mass_up_to_.begin());
  const double u = rng.uniform(), v = rng.uniform();
  return corner_[cell] + Vec2(u * cell_.x(), v * cell_.y());
}

std::vector<Vec2> initial_plane_samples(const PlaneDensity& density, std::size_t n, std::uint64_t seed,
                                        PlaneStart start) {
  geom::require(n >= least_plane_samples,
                "a periodic domain needs at least " + std::to_string(least_plane_samples) + " samples");
  geom::require(n <= most_plane_samples,
                "the number of samples must be at most " + std::to_string(most_plane_samples));
  Rng rng(seed);
  std::vector<Vec2> samples;
  samples.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = rng.uniform();
    const bool stratified = start == PlaneStart::stratified;
    samples.push_back(
        density.draw(stratified ? (static_cast<double>(i) + u) / static_cast<double>(n) : u, rng));
  }
  return samples;
}

}  // namespace fpo
