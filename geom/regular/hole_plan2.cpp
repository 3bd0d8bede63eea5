#include "geom/regular/hole_plan2.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/exact/predicates.h"

namespace geom {

void HolePlan2::plan(std::span<const SeenSite> rim) {
  rim_ = rim;
  const Bounds bounds = error_bounds();
  chains_.clear();
  pending_.clear();
  pending_.push_back({0, static_cast<std::int32_t>(rim_.size()) - 1, -1, 0});
  while (!pending_.empty()) {
    const auto [first, last, parent, which] = pending_.back();
    pending_.pop_back();
    const auto index = static_cast<std::int32_t>(chains_.size());
    if (parent >= 0) chains_[static_cast<std::size_t>(parent)].child[static_cast<std::size_t>(which)] = index;
    const std::int32_t middle = apex(first, last, bounds);
    chains_.push_back({first, middle, last, {-1, -1}});
    if (middle - first > 1) pending_.push_back({first, middle, index, 0});
    if (last - middle > 1) pending_.push_back({middle, last, index, 1});
  }
}

// With all |coordinates| <= M and weights within V of each other, the quantities of apex() are bounded by
// |b|^2, |c|^2, |b.c|, |D| <= 8 M^2 and |B|, |C| <= 8 M^2 + V, so |n| <= 16 M^2 (8 M^2 + V). D carries three
// roundings: 3u 8 M^2 < 32u M^2. The comparison n D' - n' D carries at most a dozen along each product, two
// products of at most 128 M^4 (8 M^2 + V): 24u 128 M^4 (8 M^2 + V) < 4096u M^4 (8 M^2 + V).
HolePlan2::Bounds HolePlan2::error_bounds() const {
  constexpr double u = 0x1p-53;  // unit roundoff
  double m = 0, lightest = rim_[0].weight, heaviest = lightest;
  for (const SeenSite& c : rim_) {
    m = std::max({m, std::abs(c.x), std::abs(c.y)});
    lightest = std::min(lightest, c.weight);
    heaviest = std::max(heaviest, c.weight);
  }
  const double m2 = m * m;
  return {32 * u * m2, 4096 * u * m2 * m2 * (8 * m2 + (heaviest - lightest))};
}

/// Which corner of the chain makes the triangle on its chord.
///
/// Seen from a = rim[last], with b = rim[first]: the centers of the circles orthogonal to a and b are
/// (B / 2|b|^2) b + t b', where B = |b|^2 - w_b + w_a and b' is b turned left. The one orthogonal to c too
/// has t = n / (2 |b|^2 D), n = C |b|^2 - B (b.c), D = det(b, c). Of the candidates on the left of the chord
/// (D > 0) the one of least t has no other inside its circle: compare n / D by cross multiplication.
std::int32_t HolePlan2::apex(std::int32_t first, std::int32_t last, const Bounds& bounds) const {
  if (last - first == 2) return first + 1;
  const auto corner = [&](std::int32_t k) -> const SeenSite& { return rim_[static_cast<std::size_t>(k)]; };
  const auto point = [&](std::int32_t k) {
    return WeightedPoint2{{corner(k).x, corner(k).y}, corner(k).weight};
  };
  const SeenSite& a = corner(last);
  const double bx = corner(first).x - a.x, by = corner(first).y - a.y;
  const double b2 = bx * bx + by * by, bw = b2 - (corner(first).weight - a.weight);
  std::int32_t best = -1;
  double best_n = 0, best_det = 0;
  for (std::int32_t k = first + 1; k < last; ++k) {
    const double cx = corner(k).x - a.x, cy = corner(k).y - a.y;
    const double det = bx * cy - by * cx;
    if (det < -bounds.orientation) continue;
    if (det <= bounds.orientation &&
        orient2(point(last).position, point(first).position, point(k).position) <= 0)
      continue;
    const double cw = cx * cx + cy * cy - (corner(k).weight - a.weight);
    const double n = cw * b2 - bw * (bx * cx + by * cy);
    const double lead = best_n * det - n * best_det;  // > 0: k is inside the circle with best
    bool better = best < 0 || lead > bounds.comparison;
    if (!better && lead >= -bounds.comparison) {
      const WeightedPoint2 pa = point(last), pb = point(first), pc = point(best), pe = point(k);
      better = conflicts2({&pa, a.id.value}, {&pb, corner(first).id.value}, {&pc, corner(best).id.value},
                          {&pe, corner(k).id.value});
    }
    if (better) {
      best = k;
      best_n = n;
      best_det = det;
    }
  }
  ensure(best >= 0, "no corner of the hole is on the left of a chord");
  return best;
}

}  // namespace geom
