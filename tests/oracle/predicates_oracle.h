#pragma once
// The geometric predicates, slow and obvious: homogeneous determinants and homogeneous points in exact
// numbers. The symbolic perturbation is not symbolic here: eps_r is a number, small enough.

#include "geom/power/clip_predicates.h"
#include "tests/oracle/rational.h"

namespace oracle {

/// A weighted point whose weight may be perturbed; its level is a fourth coordinate.
struct ExactSite {
  Rational x, y, z, weight, level{};
};

/// What a set of inputs covers: multiples of 2^-unit, smaller than 2^size in magnitude (weights: 2^-2 unit,
/// 2^2 size).
class Scale {
 public:
  void cover_coordinate(double x) { cover(x, 1); }
  void cover_weight(double w) { cover(w, 2); }
  void cover(const geom::WeightedPoint3& p);

  /// The number that stands for eps_rank, rank >= 0. Every predicate is a polynomial of degree at most 6,
  /// linear in the eps, with fewer than 2^60 terms: a nonzero coefficient lies between 2^-6 unit and
  /// 2^(6 size + 60), so what is 2^(6 (unit + size) + 64) times smaller cannot overrule it.
  Rational epsilon(int rank) const;

 private:
  void cover(double x, int degree);
  long unit_ = 0, size_ = 0;
};

ExactSite exact_site(const geom::WeightedPoint3& p);
ExactSite exact_site(const geom::WeightedPoint2& p);
ExactSite lifted(ExactSite site, const Rational& epsilon);

int orient2(const ExactSite& a, const ExactSite& b, const ExactSite& c);
int orient3(const ExactSite& a, const ExactSite& b, const ExactSite& c, const ExactSite& d);
int power_side2(const ExactSite& a, const ExactSite& b, const ExactSite& c, const ExactSite& e);
int power_side3(const ExactSite& a, const ExactSite& b, const ExactSite& c, const ExactSite& d,
                const ExactSite& e);

/// (x, y, z, level) / w: a corner of the restricted power diagram. No such point: w = 0.
struct HomogeneousPoint {
  Rational x, y, z, w, level{};
};
HomogeneousPoint at(const geom::Location3& q);
/// Where the line through a and b meets the bisector of i and j.
HomogeneousPoint on_edge(const geom::Location3& a, const geom::Location3& b, const ExactSite& i,
                         const ExactSite& j);
/// Where the plane of the facet meets the bisectors of i with j and k.
HomogeneousPoint in_facet(const geom::FacetCorners& facet, const ExactSite& i, const ExactSite& j,
                          const ExactSite& k);

/// The sign of Pi(point, j) - Pi(point, i).
int compare_powers(const HomogeneousPoint& point, const ExactSite& i, const ExactSite& j);

}  // namespace oracle
