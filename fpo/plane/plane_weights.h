#pragma once
// Wanted edge lengths in the plane and the weights (c h)^2 that follow from them (paper, section 3.2).

#include "fpo/domain.h"
#include "fpo/plane/plane_sizing.h"
#include "geom/ids.h"

namespace fpo {

// Which c? A sample that leaves a hole among neighbours at p_j is put where |x - p_j|^2 - w_j is the same for
// all. Wanted are distances |x - p_j| = r (h(x) + h_j) / 2, with h growing by g: at x = 0 that is
// r^2 (h^2 + h g.p_j + ...), while w_j = c^2 (h^2 + 2 h g.p_j + ...). The linear terms agree if 2 c^2 = r^2,
// and r is about 0.95 when FPO has converged, so c near .68 keeps the grading as it is. Measured (bench-plane
// adaptive): with c = .68 the slope of log spacing against log rho is .98 .. 1.01 after 100 local iterations
// and 1.00 .. 1.04 after 400; with c = 2/3 it is .96 .. 1.00 and stays; c = .64 makes it fall to .93, c = .70
// rise to 1.05. The global variant takes samples from dense places to fill the random set's voids in sparse
// ones (its slope is .75 after one iteration with c = .66); a larger c, .75, prevents that and then slowly
// over-grades.
inline double best_plane_weight_factor(Scope scope) { return scope == Scope::global ? 0.75 : 0.68; }

class PlaneWeights {
 public:
  /// Keeps a reference to the sizing. `scale`: s of h = s rho (PlaneDensity); `factor`: c.
  PlaneWeights(const PlaneSizing& sizing, double scale, double factor)
      : sizing_(sizing), scale_(scale), factor_(sizing.is_uniform() ? 0 : factor) {}

  /// All weights are 0.
  bool is_uniform() const { return factor_ == 0; }
  /// h
  double edge_length(const geom::Vec2& x) const { return scale_ * sizing_.rho(x); }
  /// The h that gave a sample this weight.
  double edge_length(SiteId x, double weight) const;
  /// The weight of the sample x at a place, its share of what the sizing gives there.
  double weight(SiteId x, const geom::Vec2& place) const { return share(x) * full_weight(place); }
  double full_weight(const geom::Vec2& place) const;
  /// In (0, 1].
  double share(SiteId x) const { return shares_.empty() ? 1 : shares_[x]; }
  /// `num_samples`: of all.
  void set_share(SiteId x, double share, std::size_t num_samples);

 private:
  const PlaneSizing& sizing_;
  double scale_, factor_;
  geom::Table<SiteId, double> shares_;  ///< empty: all 1
};

}  // namespace fpo
