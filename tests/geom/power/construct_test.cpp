// Rounded corners against exact ones: the stated tolerances hold on harmless and on nasty facets.

#include "geom/power/construct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/oracle/predicates_oracle.h"

using geom::Bisector;
using geom::FacetCorners;
using geom::RankedPoint3;
using geom::Rng;
using geom::RoundedPoint;
using geom::Vec3;
using geom::WeightedPoint3;
using oracle::ExactSite;
using oracle::HomogeneousPoint;
using oracle::Rational;

namespace {

constexpr int construct_draws = 3000;  // of each setting

enum class Setting {
  benign,
  sliver,      ///< the third corner close to the opposite edge
  needle,      ///< two corners close together
  far,         ///< a small facet far from the origin
  parallel,    ///< sites nearly on one line: bisectors nearly parallel
  close,       ///< sites close together
  upright,     ///< sites nearly above one another: bisectors nearly parallel to the facet
  heavy,       ///< large weights
  coordinate,  ///< small integers: bisectors through corners and along edges
  distant      ///< a small facet, sites far away
};
constexpr Setting all_settings[] = {Setting::benign,     Setting::sliver, Setting::needle,  Setting::far,
                                    Setting::parallel,   Setting::close,  Setting::upright, Setting::heavy,
                                    Setting::coordinate, Setting::distant};

Vec3 random_vector(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }
Vec3 small_integers(Rng& rng) { return {double(rng.below(4)), double(rng.below(4)), double(rng.below(4))}; }
double small(Rng& rng) { return std::exp2(rng.uniform(-45, -5)); }

/// A facet and three sites whose bisectors cross near a point of the facet, as far as the setting allows.
struct ConstructScene {
  std::array<Vec3, 3> q;
  std::array<WeightedPoint3, 3> site;
  std::array<ExactSite, 3> exact;
  double extent = 0;

  ConstructScene(Setting setting, Rng& rng) {
    for (Vec3& x : q) x = setting == Setting::coordinate ? small_integers(rng) : random_vector(rng);
    if (setting == Setting::sliver)
      q[2] = q[0] + rng.uniform(-0.5, 1.5) * (q[1] - q[0]) + small(rng) * random_vector(rng);
    if (setting == Setting::needle) q[1] = q[0] + small(rng) * random_vector(rng);
    if (setting == Setting::far || setting == Setting::distant) {
      const Vec3 origin = setting == Setting::far ? Vec3(1e3 * random_vector(rng)) : random_vector(rng);
      const double size = std::exp2(rng.uniform(-30, 0));
      for (Vec3& x : q) x = origin + size * x;
    }
    const double s = rng.uniform(), t = rng.uniform(0, 1 - s);
    place_sites(setting, q[0] + s * (q[1] - q[0]) + t * (q[2] - q[0]), rng);
    for (const Vec3& x : q) extent = std::max(extent, x.lpNorm<Eigen::Infinity>());
    for (std::size_t i = 0; i < 3; ++i) {
      extent = std::max(extent, site[i].position.lpNorm<Eigen::Infinity>());
      exact[i] = oracle::exact_site(site[i]);
    }
  }
  ConstructScene(const ConstructScene&) = delete;

  RankedPoint3 ranked(int i) const { return {&site[std::size_t(i)], i}; }
  Bisector bisector(int j) const { return geom::bisector(site[0], site[std::size_t(j)], extent); }

 private:
  void place_sites(Setting setting, const Vec3& target, Rng& rng) {
    const double size = (q[1] - q[0]).norm() + (q[2] - q[0]).norm();
    const Vec3 along = random_vector(rng), normal = (q[1] - q[0]).cross(q[2] - q[0]).normalized();
    const double off = small(rng), closeness = small(rng);
    for (auto& [x, w, level] : site) {
      x = target + size * random_vector(rng);
      if (setting == Setting::parallel)
        x = target + size * (rng.uniform(-1, 1) * along + off * random_vector(rng));
      if (setting == Setting::close) x = target + size * (along + closeness * random_vector(rng));
      if (setting == Setting::upright)
        x = target + size * (rng.uniform(-1, 1) * normal + off * random_vector(rng));
      if (setting == Setting::distant) x = target + 1e6 * size * random_vector(rng);
      if (setting == Setting::coordinate) x = small_integers(rng);
      const double common = setting == Setting::heavy ? 1e8 : 0;
      w = setting == Setting::coordinate ? double(rng.below(3)) : common + (x - target).squaredNorm();
    }
  }
};

/// |rounded - exact| <= tolerance, in exact numbers: |w rounded - (x, y, z)|^2 <= (w tolerance)^2.
bool within(const RoundedPoint& rounded, const HomogeneousPoint& exact) {
  if (std::isinf(rounded.tolerance)) return true;
  const Rational dx = exact.w * Rational(rounded.position.x()) - exact.x,
                 dy = exact.w * Rational(rounded.position.y()) - exact.y,
                 dz = exact.w * Rational(rounded.position.z()) - exact.z;
  const Rational allowed = exact.w * Rational(rounded.tolerance);
  return (dx * dx + dy * dy + dz * dz - allowed * allowed).sign() <= 0;
}

/// f at q, exactly.
Rational form(const Vec3& q, const ExactSite& owner, const ExactSite& j) {
  const auto power = [&](const ExactSite& s) {
    const Rational dx = Rational(q.x()) - s.x, dy = Rational(q.y()) - s.y, dz = Rational(q.z()) - s.z;
    return dx * dx + dy * dy + dz * dz - s.weight;
  };
  return power(j) - power(owner);
}

/// Does the exact corner of site 0 with 1 and 2 exist, and does it lie in the facet?
bool corner_is_in_facet(const ConstructScene& s) {
  std::array<Rational, 3> f, g;
  for (std::size_t i = 0; i < 3; ++i) {
    f[i] = form(s.q[i], s.exact[0], s.exact[1]);
    g[i] = form(s.q[i], s.exact[0], s.exact[2]);
  }
  const std::array<Rational, 3> lambda{f[1] * g[2] - f[2] * g[1], f[2] * g[0] - f[0] * g[2],
                                       f[0] * g[1] - f[1] * g[0]};
  const int sum = (lambda[0] + lambda[1] + lambda[2]).sign();
  return sum != 0 && std::ranges::none_of(lambda, [&](const Rational& l) { return l.sign() * sum < 0; });
}

struct ConstructCount {
  int corners = 0, certain = 0;
};

/// Runs `test(scene, count)` on construct_draws of every setting.
template <class Test>
ConstructCount construct_for_each_scene(std::uint64_t seed, Test test) {
  Rng rng(seed);
  ConstructCount all;
  for (const Setting setting : all_settings) {
    INFO("setting: " << static_cast<int>(setting));
    ConstructCount count;
    for (int i = 0; i < construct_draws; ++i) test(ConstructScene(setting, rng), count);
    CHECK(count.corners > construct_draws / 50);
    all.corners += count.corners;
    all.certain += count.certain;
  }
  return all;
}

}  // namespace

TEST_CASE("construct: the error of a bisector stays within its bound") {
  construct_for_each_scene(1, [](const ConstructScene& s, ConstructCount& count) {
    ++count.corners;
    const Bisector b = s.bisector(1);
    for (const Vec3& x : s.q) {
      const Rational error = Rational(b(x)) - form(x, s.exact[0], s.exact[1]);
      CHECK((error * error - Rational(b.error) * Rational(b.error)).sign() <= 0);
    }
  });
}

// Whichever way a corner is found, it must have the same bits.
TEST_CASE("construct: bisectors side by side have the bits of each by itself, and so have their minors") {
  construct_for_each_scene(4, [](const ConstructScene& s, ConstructCount& count) {
    ++count.corners;
    const geom::BisectorPair pair(s.site[0], s.site[1], s.site[2], s.extent);
    geom::FormPair forms;
    for (int lane = 0; lane < 2; ++lane) {
      const Bisector b = s.bisector(lane + 1);
      CHECK(pair.error[lane] == b.error);
      for (std::size_t i = 0; i < 3; ++i) {
        forms.f[i] = pair(s.q[i]);
        CHECK(forms.f[i][lane] == b(s.q[i]));
      }
    }
    forms.error = pair.error;
    const geom::LinearForm first = linear_form(s.bisector(1), s.q[0], s.q[1], s.q[2]),
                           second = linear_form(s.bisector(2), s.q[0], s.q[1], s.q[2]);
    const geom::AxisMinors minors = axis_minors(forms, axis_numbers(forms));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      CHECK(minors.l[i] == first.f[j] * second.f[k] - first.f[k] * second.f[j]);
    }
    CHECK(minors.sum == minors.l[0] + minors.l[1] + minors.l[2]);
    CHECK(minors.sum_error >= 3 * minors.error);
  });
}

TEST_CASE("construct: a corner on an edge is as near to the exact one as stated") {
  const ConstructCount count =
      construct_for_each_scene(2, [](const ConstructScene& s, ConstructCount& count) {
        for (const auto& [i, k] : {std::pair(0u, 1u), std::pair(1u, 2u), std::pair(0u, 2u)}) {
          const Vec3 &a = s.q[i], &b = s.q[k];
          const int at_a = form(a, s.exact[0], s.exact[1]).sign(),
                    at_b = form(b, s.exact[0], s.exact[1]).sign();
          if (at_a * at_b > 0 || (at_a == 0 && at_b == 0)) continue;
          const HomogeneousPoint exact = on_edge(a, b, s.exact[0], s.exact[1]);
          const Bisector f = s.bisector(1);
          const RoundedPoint rounded = geom::corner_on_edge(a, b, f(a), f(b), f.error, s.extent);
          CHECK(within(rounded, exact));
          CHECK(within(exact_corner_on_edge(a, b, s.ranked(0), s.ranked(1), s.extent), exact));
          ++count.corners;
          count.certain += rounded.tolerance <= 0x1p-32 * s.extent;
        }
      });
  CHECK(count.certain > count.corners / 2);
  CHECK(count.certain < count.corners);
}

TEST_CASE("construct: a corner in a facet is as near to the exact one as stated") {
  const ConstructCount count =
      construct_for_each_scene(3, [](const ConstructScene& s, ConstructCount& count) {
        if (!corner_is_in_facet(s)) return;
        const HomogeneousPoint exact =
            in_facet(FacetCorners{&s.q[0], &s.q[1], &s.q[2]}, s.exact[0], s.exact[1], s.exact[2]);
        const RoundedPoint rounded =
            geom::corner_in_facet(s.q[0], s.q[1], s.q[2],
                                  axis_minors(linear_form(s.bisector(1), s.q[0], s.q[1], s.q[2]),
                                              linear_form(s.bisector(2), s.q[0], s.q[1], s.q[2])),
                                  s.extent);
        CHECK(within(rounded, exact));
        CHECK(within(
            exact_corner_in_facet(s.q[0], s.q[1], s.q[2], s.ranked(0), s.ranked(1), s.ranked(2), s.extent),
            exact));
        ++count.corners;
        count.certain += rounded.tolerance <= 0x1p-32 * s.extent;
      });
  CHECK(count.certain > count.corners / 4);
  CHECK(count.certain < count.corners);
}
