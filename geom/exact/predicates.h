#pragma once
// Exact geometric predicates on weighted points (design: "combinatorial decisions are exact in the stored
// doubles").
//
// Every function returns the exact sign for the doubles given: a floating-point filter with a proven bound
// first, expansion arithmetic (expansion.h) where the filter cannot tell. Ties of the power tests are broken
// by one symbolic rule: the weight of a point of rank r is w + eps_r with eps_0 >> eps_1 >> ... > 0
// infinitesimal, so among equals the smaller rank has the larger weight. The rank of a sample is its id. No
// conflicts*/beats_* test ever ties.
//
// Valid range. Every predicate is exact for coordinates that are multiples of 2^-160 and at most 2^160 in
// magnitude, with weights that are multiples of 2^-320 and at most 2^320 (whence: expansion.h). Surfaces of
// any size come into it by scaling.h. One of degree d in the coordinates allows more: multiples of
// 2^-floor(1074/d), at most 2^(floor(1000/d) - 4), weights their squares; at either end no product under- or
// overflows.
//
//     d = 2   orient2, beats_at_vertex     2^-537 .. 2^496
//         3   orient3                      2^-358 .. 2^329
//         4   power_side2, conflicts2,     2^-268 .. 2^246
//             beats_on_edge
//         5   power_side3, conflicts3      2^-214 .. 2^196
//         6   beats_in_facet               2^-179 .. 2^162
//
// Beyond, answers may be wrong: 2^-600 times 2^-600 is 0. Cost: tens of flops where the filter decides.

#include <cstdint>

#include "geom/vec.h"

namespace geom {

/// A weighted point and its place in the symbolic perturbation; ranks are distinct within one test.
struct RankedPoint3 {
  const WeightedPoint3* point;
  std::int32_t rank;
};
struct RankedPoint2 {
  const WeightedPoint2* point;
  std::int32_t rank;
};

/// Sign of det[b - a, c - a]: +1 if a, b, c turn left.
int orient2(const Vec2& a, const Vec2& b, const Vec2& c);

/// Sign of det[b - a, c - a, d - a]: +1 if a, b, c appear counterclockwise from d.
int orient3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the power of e with respect to the circle orthogonal to a, b, c, less the weight of e, times
/// orient2(a, b, c): -1 if e lies inside for a counterclockwise triangle. 0 on a tie.
int power_side2(const WeightedPoint2& a, const WeightedPoint2& b, const WeightedPoint2& c,
                const WeightedPoint2& e);

/// The same in space for a tetrahedron: -1 if e lies inside the orthosphere and orient3(a, b, c, d) > 0. 0 on
/// a tie.
int power_side3(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
                const WeightedPoint3& d, const WeightedPoint3& e);

/// Does e lie inside the orthocircle of a, b, c after the symbolic perturbation? Requires orient2(a, b, c) >
/// 0.
bool conflicts2(const RankedPoint2& a, const RankedPoint2& b, const RankedPoint2& c, const RankedPoint2& e);

/// Does e lie inside the orthosphere of a, b, c, d after the symbolic perturbation? Requires orient3(a, b, c,
/// d) > 0.
bool conflicts3(const RankedPoint3& a, const RankedPoint3& b, const RankedPoint3& c, const RankedPoint3& d,
                const RankedPoint3& e);

}  // namespace geom
