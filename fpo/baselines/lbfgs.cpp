#include "fpo/baselines/lbfgs.h"

#include <vector>

namespace fpo {

using Eigen::VectorXd;

void LbfgsMemory::push(const VectorXd& step, const VectorXd& gradient_change) {
  const double sy = step.dot(gradient_change);
  if (!(sy > 1e-10 * step.norm() * gradient_change.norm())) return;
  pairs_.push_back({step, gradient_change, sy});
  if (pairs_.size() > most_) pairs_.pop_front();
}

VectorXd LbfgsMemory::direction(const VectorXd& gradient, const VectorXd& scale) const {
  VectorXd q = gradient;
  std::vector<double> alphas(pairs_.size());
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    alphas[i] = pairs_[i].s.dot(q) / pairs_[i].sy;
    q -= alphas[i] * pairs_[i].y;
  }
  q = q.cwiseProduct(scale);
  if (!pairs_.empty()) {  // so that the curvature along the last step is right from the start
    const Pair& last = pairs_.back();
    const double curvature = last.y.dot(last.y.cwiseProduct(scale));
    if (curvature > 0) q *= last.sy / curvature;
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    q += (alphas[i] - pairs_[i].y.dot(q) / pairs_[i].sy) * pairs_[i].s;
  return -q;
}

}  // namespace fpo
