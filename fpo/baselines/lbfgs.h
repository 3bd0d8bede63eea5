#pragma once
// The limited-memory BFGS method (Nocedal, Updating quasi-Newton matrices with limited storage, 1980): what
// the last steps tell of the curvature, and the direction that follows. Liu et al. 2009 use it for CVT.

#include <Eigen/Core>
#include <cstddef>
#include <deque>

namespace fpo {

class LbfgsMemory {
 public:
  /// Remembers the last `most` steps.
  explicit LbfgsMemory(std::size_t most) : most_(most) {}

  /// A step and the change of the gradient along it. Ignored unless the curvature along it is positive.
  void push(const Eigen::VectorXd& step, const Eigen::VectorXd& gradient_change);
  void clear() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// -H g, where H approximates the inverse Hessian: from a multiple of the diagonal `scale` (entries not
  /// negative), corrected by the steps remembered (the two-loop recursion). A direction of descent. O(most *
  /// size).
  Eigen::VectorXd direction(const Eigen::VectorXd& gradient, const Eigen::VectorXd& scale) const;

 private:
  struct Pair {
    Eigen::VectorXd s, y;
    double sy;
  };
  std::size_t most_;
  std::deque<Pair> pairs_;  ///< the oldest first
};

}  // namespace fpo
