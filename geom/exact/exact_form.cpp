#include "geom/exact/exact_form.h"

namespace geom {

Expansion form_at(const Vec3& q, const RankedPoint3& owner, const RankedPoint3& j) {
  const WeightedPoint3 &p0 = *owner.point, &pj = *j.point;
  Expansion f = Expansion::difference(p0.weight, pj.weight);
  for (int k = 0; k < 3; ++k) {
    const Expansion towards = Expansion::difference(p0.position[k], pj.position[k]);
    const Expansion twice =
        Expansion::difference(q[k], p0.position[k]) + Expansion::difference(q[k], pj.position[k]);
    f = f + towards * twice;
  }
  return f;
}

}  // namespace geom
