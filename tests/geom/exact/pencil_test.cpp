// The filter of pencil.h against the exact predicates: whatever it is certain of is so.

#include "geom/exact/pencil.h"

#include <cmath>

#include "doctest.h"
#include "geom/exact/predicates.h"
#include "geom/rng.h"

using geom::DoubleDouble;
using geom::Pencil;
using geom::Rng;
using geom::Vec3;
using geom::WeightedPoint3;

namespace {

struct Tally {
  int asked = 0, uncertain = 0;
};

/// Five points: a positive tetrahedron and one more. All that Pencil<Real> claims must be exact.
template <class Real>
void pencil_compare(const WeightedPoint3 (&p)[5], Tally& tally) {
  const Pencil<Real> pencil(p[0], p[1], p[2]);
  const auto d = pencil.place(p[3]), e = pencil.place(p[4]);
  ++tally.asked;
  if (const int side = pencil.side(e); side != 0) {
    CHECK(side == geom::orient3(p[0].position, p[1].position, p[2].position, p[4].position));
  }
  const int side = pencil.power_side(d, e);
  if (side == 0) {
    ++tally.uncertain;
  } else {
    CHECK(side == geom::power_side3(p[0], p[1], p[2], p[3], p[4]));
  }
}

struct Tallies {
  Tally coarse, fine;
};

template <class Draw>
Tallies compare_many(int count, Draw draw) {
  Rng rng(1);
  Tallies tallies;
  while (tallies.coarse.asked < count) {
    WeightedPoint3 p[5];
    for (WeightedPoint3& q : p) q = draw(rng);
    const int side = geom::orient3(p[0].position, p[1].position, p[2].position, p[3].position);
    if (side == 0) {
      ++tallies.coarse.asked;
      continue;
    }
    if (side < 0) std::swap(p[0], p[1]);
    pencil_compare<double>(p, tallies.coarse);
    pencil_compare<DoubleDouble>(p, tallies.fine);
  }
  return tallies;
}

Vec3 random_vector(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }

}  // namespace

TEST_CASE("pencil: random weighted points are decided in doubles, and right") {
  const Tallies t = compare_many(5000, [](Rng& rng) {
    return WeightedPoint3{random_vector(rng), rng.uniform(-1, 1)};
  });
  CHECK(t.coarse.uncertain < t.coarse.asked / 50);
  CHECK(t.fine.uncertain == 0);
}

TEST_CASE("pencil: rounded cospherical points are decided in twofold precision, and right") {
  const Tallies t = compare_many(5000, [](Rng& rng) {
    return WeightedPoint3{random_vector(rng).normalized(), 0.0};
  });
  CHECK(t.coarse.uncertain > t.coarse.asked * 9 / 10);
  CHECK(t.fine.uncertain < t.fine.asked / 50);
}

TEST_CASE("pencil: exact ties are left open, rounded planes and wide scales decided right or left open") {
  const Tallies ties = compare_many(3000, [](Rng& rng) {
    Vec3 at(2, 2, 2);
    at[static_cast<int>(rng.below(3))] = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (rng.below(2) == 1) at[axis] = -at[axis];
    }
    return WeightedPoint3{at, 0.25};
  });
  CHECK(ties.fine.uncertain == ties.fine.asked);
  compare_many(5000, [](Rng& rng) {
    Vec3 at = rng.uniform(-1, 1) * Vec3(1, 2, -0.3).normalized() +
              rng.uniform(-1, 1) * Vec3(0.2, 0.1, 1.1).normalized();
    at.x() = std::nextafter(at.x(), 2.0);
    return WeightedPoint3{at, 0.0};
  });
  compare_many(5000, [](Rng& rng) {
    const double scale = std::exp2(rng.uniform(-150, 75));
    return WeightedPoint3{scale * random_vector(rng), rng.uniform(-1, 1) * scale * scale};
  });
  compare_many(5000, [](Rng& rng) {
    const auto tiny = [&] { return std::exp2(-static_cast<double>(rng.below(170))) * rng.uniform(-1, 1); };
    return WeightedPoint3{Vec3(1, 1, 1) + Vec3(tiny(), tiny(), tiny()), 0.0};
  });
}
