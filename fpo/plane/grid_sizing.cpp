#include "fpo/plane/grid_sizing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpo {

using geom::FlatTorus;
using geom::Vec2;

namespace {

class GridSizing final : public PlaneSizing {
 public:
  GridSizing(PeriodicGrid grid, const FlatTorus& torus)
      : grid_(std::move(grid)),
        cells_per_length_(static_cast<double>(grid_.width) / torus.period().x(),
                          static_cast<double>(grid_.height) / torus.period().y()) {}

  double rho(const Vec2& x) const override {
    const auto [i, i1, u] = place(x.x() * cells_per_length_.x(), grid_.width);
    const auto [j, j1, v] = place(x.y() * cells_per_length_.y(), grid_.height);
    return (1 - v) * ((1 - u) * grid_.at(i, j) + u * grid_.at(i1, j)) +
           v * ((1 - u) * grid_.at(i, j1) + u * grid_.at(i1, j1));
  }

 private:
  struct Place {
    std::size_t before, after;
    double share;  ///< of the latter
  };
  /// Between which centers a coordinate in [0, n], counted in cells, lies.
  static Place place(double x, std::size_t n) {
    const double shifted = x - 0.5 < 0 ? x - 0.5 + static_cast<double>(n) : x - 0.5;
    const auto before = std::min(static_cast<std::size_t>(shifted), n - 1);
    return {before, before + 1 < n ? before + 1 : 0, std::min(shifted - static_cast<double>(before), 1.0)};
  }

  PeriodicGrid grid_;
  Vec2 cells_per_length_;
};

/// Lowers values until none exceeds a neighbour's by more than slope times their distance: sweeps over the
/// grid in both directions, each seeing what it has lowered already, until nothing changes.
void limit_slope(PeriodicGrid& grid, const Vec2& cell, double slope) {
  const double along_x = slope * cell.x(), along_y = slope * cell.y(), across = slope * cell.norm();
  const std::size_t w = grid.width, h = grid.height;
  for (bool changed = true; changed;) {
    changed = false;
    const auto relax = [&](std::size_t i, std::size_t j) {
      const std::size_t left = i > 0 ? i - 1 : w - 1, right = i + 1 < w ? i + 1 : 0;
      const std::size_t below = j > 0 ? j - 1 : h - 1, above = j + 1 < h ? j + 1 : 0;
      const double most = std::min({std::min(grid.at(left, j), grid.at(right, j)) + along_x,
                                    std::min(grid.at(i, below), grid.at(i, above)) + along_y,
                                    std::min(std::min(grid.at(left, below), grid.at(right, below)),
                                             std::min(grid.at(left, above), grid.at(right, above))) +
                                        across});
      if (grid.at(i, j) <= most) return;
      grid.at(i, j) = most;
      changed = true;
    };
    for (std::size_t j = 0; j < h; ++j)
      for (std::size_t i = 0; i < w; ++i) relax(i, j);
    for (std::size_t j = h; j-- > 0;)
      for (std::size_t i = w; i-- > 0;) relax(i, j);
  }
}

}  // namespace

std::unique_ptr<PlaneSizing> grid_sizing(const PeriodicGrid& rho, const FlatTorus& torus,
                                         std::size_t num_samples, double gradation) {
  const Vec2 cell(torus.period().x() / static_cast<double>(rho.width),
                  torus.period().y() / static_cast<double>(rho.height));
  // The scale s of h = s rho follows from the integral of the limited rho^-2, which limits rho's slope to
  // gradation / s. Limiting raises the integral and s, so s increases towards its fixed point.
  PeriodicGrid grid = rho;
  for (int round = 0; round < 4; ++round) {
    double integral = 0;
    for (const double r : grid.value) integral += cell.x() * cell.y() / (r * r);
    const double scale = std::sqrt(2 * integral / (std::numbers::sqrt3 * static_cast<double>(num_samples)));
    grid = rho;
    limit_slope(grid, cell, gradation / scale);
  }
  return std::make_unique<GridSizing>(std::move(grid), torus);
}

}  // namespace fpo
