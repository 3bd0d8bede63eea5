#pragma once
// How long edges should be where in the plane (paper, section 3.2: the sizing function rho), and the initial
// samples that follow it.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geom/flat_torus.h"
#include "geom/rng.h"
#include "geom/vec.h"

namespace fpo {

/// A positive periodic function rho on the torus: the wanted edge length up to a factor. Thread-safe.
class PlaneSizing {
 public:
  virtual ~PlaneSizing() = default;
  virtual double rho(const geom::Vec2& x) const = 0;
  /// True if rho is 1 everywhere: then samples need no weights.
  virtual bool is_uniform() const { return false; }
};

/// rho = 1.
class UniformSizing final : public PlaneSizing {
 public:
  double rho(const geom::Vec2&) const override { return 1; }
  bool is_uniform() const override { return true; }
};

/// A named analytic field on the torus: "uniform", "waves5", "spot11", ... (sizing_names() lists all; the
/// number is max rho / min rho). Null for an unknown name.
std::unique_ptr<PlaneSizing> named_sizing(const std::string& name, const geom::FlatTorus& torus);
std::vector<std::string> sizing_names();

/// The density rho^-2 tabulated on a grid: its integral, and independent draws from it.
class PlaneDensity {
 public:
  /// `resolution`: grid cells along the longer period. O(resolution^2). Throws InputError if rho is not
  /// positive and finite somewhere on the grid.
  PlaneDensity(const PlaneSizing& sizing, const geom::FlatTorus& torus, int resolution = 512);

  /// I of h = s rho, s = sqrt(2 / sqrt(3) I / n): the integral of rho^-2 over the torus (midpoint rule).
  double integral() const { return integral_; }
  /// The factor s between rho and the wanted edge length for n samples.
  double edge_length_scale(std::size_t n) const;
  geom::Vec2 draw(geom::Rng& rng) const;

 private:
  geom::Vec2 period_;
  std::size_t columns_, rows_;
  std::vector<double> mass_up_to_;  ///< cumulated over the cells; empty if uniform
  double integral_;
};

/// Exactly n samples, drawn independently with density proportional to rho^-2. A function of its arguments.
/// Throws InputError if n is less than least_plane_samples or absurd.
std::vector<geom::Vec2> random_plane_samples(const PlaneDensity& density, std::size_t n, std::uint64_t seed);

}  // namespace fpo
