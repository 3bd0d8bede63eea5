#pragma once
// How long edges should be where in the plane (paper, section 3.2: the sizing function rho), and the initial
// samples that follow it.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geom/regular/flat_torus.h"
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

/// The density rho^-2 tabulated on a grid whose cells are taken along a Hilbert curve: its integral, and
/// locations by the share of the integral that comes before them.
class PlaneDensity {
 public:
  /// `resolution`: grid cells along the longer period. O(resolution^2 log). Throws InputError if rho is not
  /// positive and finite somewhere on the grid.
  PlaneDensity(const PlaneSizing& sizing, const geom::FlatTorus& torus, int resolution = 512);

  /// The integral of rho^-2 over the torus (midpoint rule).
  double integral() const { return mass_up_to_.back(); }
  /// The factor s between rho and the wanted edge length h for n samples: sqrt(2 / sqrt(3) integral / n).
  double edge_length_scale(std::size_t n) const;
  /// A random location in the grid cell up to which the given share, in [0, 1), of the integral is reached.
  geom::Vec2 draw(double share, geom::Rng& rng) const;

 private:
  geom::Vec2 cell_;                 ///< size of a grid cell
  std::vector<geom::Vec2> corner_;  ///< of each, in the curve's order
  std::vector<double> mass_up_to_;  ///< cumulated
};

/// How the initial samples are drawn: independently, or one in each of n parts of equal integral along the
/// curve. The latter spreads the samples, so that fewer of them must travel far.
enum class PlaneStart { random, stratified };

/// Exactly n samples with density proportional to rho^-2. A function of its arguments. Throws InputError if n
/// is less than least_plane_samples or absurd.
std::vector<geom::Vec2> initial_plane_samples(const PlaneDensity& density, std::size_t n, std::uint64_t seed,
                                              PlaneStart start = PlaneStart::random);

}  // namespace fpo
