#include "geom/exact/exact_form.h"

namespace geom {

Expansion form_at(const Location3& q, const RankedPoint3& owner, const RankedPoint3& j) {
  const WeightedPoint3 &p0 = *owner.point, &pj = *j.point;
  Expansion f = Expansion::difference(p0.weight, pj.weight);
  const auto add = [&](double x, double own, double other) {
    f = f +
        Expansion::difference(own, other) * (Expansion::difference(x, own) + Expansion::difference(x, other));
  };
  for (int k = 0; k < 3; ++k) add(q.position[k], p0.position[k], pj.position[k]);
  if (p0.level != pj.level) add(q.level, p0.level, pj.level);
  return f;
}

}  // namespace geom
