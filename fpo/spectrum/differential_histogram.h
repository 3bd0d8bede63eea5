#pragma once
// A sum of cosines over very many vectors: sum_k w_k cos(2 pi f.d_k) on a grid of frequencies f.

#include <cstddef>
#include <vector>

#include "geom/vec.h"

namespace fpo {

/// Vectors are spread over a grid by a cubic B-spline, the grid is transformed axis by axis, and the spline's
/// own transform is divided out. What remains is aliasing: vectors look as if they also had frequencies
/// beyond 1 / cell - f, damped by (f cell / (1 - f cell))^4; at 1/8 of the grid's sampling frequency that is
/// 4e-4. Cost: 16 additions a vector; the transform O(G^2 F + G F^2) for G grid points and F frequencies
/// along an axis.
class DifferentialHistogram {
 public:
  /// Takes vectors with both coordinates below `reach`, wanted at frequencies up to max_frequency along each
  /// axis. Throws geom::InputError if the grid would be absurdly large.
  DifferentialHistogram(double reach, double max_frequency);

  void add(const geom::Vec2& d, double weight);
  /// Adds another histogram of the same shape.
  void merge(const DifferentialHistogram& other);

  /// The sums at (i step, j step), |i|, |j| <= half, row by row with j = -half first; those of f and -f are
  /// the same to the bit. Shared among threads with the same result for any number of them. half step must
  /// not exceed max_frequency.
  std::vector<double> transform(double step, int half, int threads) const;

  double cell() const { return cell_; }

 private:
  double reach_, max_frequency_, cell_;
  int size_;    ///< grid points along an axis
  int center_;  ///< the grid point of d = 0
  std::vector<double> mass_;
};

}  // namespace fpo
