#include "tests/storm/draws.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/storm/wide_oracle.h"

namespace storm {
namespace {

using geom::Rng;
using geom::Vec3;
using geom::WeightedPoint3;
using Points = std::span<WeightedPoint3>;

constexpr int num_hardships = std::size(fixtures::all_hardships);
constexpr const char* own_bases[] = {"span", "twins", "common corner"};
constexpr Range narrow{-160, 160};  ///< what every predicate takes

/// The nearest multiple of 2^unit.
double to_multiple(double x, int unit) { return std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit); }

double of_any_size(Rng& rng, const Range& r) {
  const int exponent = r.unit + static_cast<int>(rng.below(static_cast<std::uint64_t>(r.top - r.unit)));
  return std::abs(exponent - r.unit) < 54 ? to_multiple(std::ldexp(rng.uniform(-1, 1), exponent), r.unit)
                                          : std::ldexp(rng.uniform(-1, 1), exponent - 1);
}

/// Every number of another size, from one end of the range to the other.
void draw_span(Points points, Rng& rng) {
  for (auto& [x, w, level] : points) {
    for (double& c : x) c = to_multiple(of_any_size(rng, narrow), narrow.unit);
    w = to_multiple(of_any_size(rng, {2 * narrow.unit, 2 * narrow.top}), 2 * narrow.unit);
  }
}

/// All within some ulps of one point.
void draw_twins(Points points, Rng& rng) {
  const Vec3 center(rng.uniform(0.5, 2), rng.uniform(0.5, 2), rng.uniform(0.5, 2));
  for (auto& [x, w, level] : points) {
    for (int k = 0; k < 3; ++k) x[k] = center[k] + 0x1p-52 * fixtures::small_integer(rng, 4);
    w = rng.below(2) == 0 ? 0.25 : 0.25 + 0x1p-54 * fixtures::small_integer(rng, 4);
  }
}

/// Sites that all have the same power at one integer point, which is a corner, or on an edge, or in the
/// facet.
void draw_common_corner(Points points, const Kind::Order& order, Rng& rng) {
  const auto integers = [&](int n) {
    Vec3 p;
    for (double& c : p) c = fixtures::small_integer(rng, 2 * n + 1) - n;
    if (order.flat) p.z() = 0;
    return p;
  };
  const Vec3 center = integers(8);
  const double power = order.flat ? 23 : 48;
  const Points sites = points.first(points.size() - order.corners), corners = points.last(order.corners);
  for (auto& [x, w, level] : sites) {
    x = rng.below(2) == 0 ? fixtures::on_integer_sphere(rng, order.flat) : integers(5);
    w = x.squaredNorm() - power;
    x += center;
  }
  if (corners.empty()) return;
  const Vec3 a = integers(3), b = integers(3);
  const bool on_vertex = corners.size() == 1 || rng.below(4) == 0;
  const bool on_edge = corners.size() == 2 || rng.below(2) == 0;
  corners[0].position = on_vertex ? center : on_edge ? Vec3(center - a) : Vec3(center - a - b);
  if (corners.size() > 1)
    corners[1].position = center + (on_edge ? 1 + fixtures::small_integer(rng, 3) : 1) * a;
  if (corners.size() > 2) corners[2].position = center + b;
}

/// One unit in the last place up or down, at least `unit`.
double one_off(double x, double unit, Rng& rng) {
  if (rng.below(4) != 0) return x;
  const double ulp = std::max(std::nextafter(std::abs(x), HUGE_VAL) - std::abs(x), unit);
  return rng.below(2) == 0 ? x + ulp : x - ulp;
}

void scale(Points points, int exponent) {
  for (auto& [x, w, level] : points) {
    for (double& c : x) c = std::ldexp(c, exponent);
    w = std::ldexp(w, 2 * exponent);
  }
}

/// The least e such that all coordinates are below 2^e, and all weights below 2^2e.
int size_of(std::span<const WeightedPoint3> points) {
  int size = -2000;
  for (const WeightedPoint3& p : points) {
    int exponent = 0;
    for (const double c : p.position)
      if (c != 0) std::frexp(c, &exponent), size = std::max(size, exponent);
    if (p.weight != 0)
      std::frexp(p.weight, &exponent),
          size = std::max(size, exponent > 0 ? (exponent + 1) / 2 : exponent / 2);
  }
  return size;
}

}  // namespace

const std::vector<Kind>& Kind::all() {
  static const std::vector<Kind> kinds = [] {
    std::vector<Kind> result;
    for (const Change change : {Change::none, Change::ulps, Change::low, Change::high})
      for (int base = 0; base < num_hardships + static_cast<int>(std::size(own_bases)); ++base)
        result.push_back(Kind(base, change));
    return result;
  }();
  return kinds;
}

std::string Kind::name() const {
  constexpr const char* changes[] = {"", ", one ulp off", ", low end", ", high end"};
  const std::string base = base_ < num_hardships ? fixtures::name_of(fixtures::all_hardships[base_])
                                                 : own_bases[base_ - num_hardships];
  return base + changes[static_cast<int>(change_)];
}

void Kind::draw(Points points, const Order& order, Rng& rng) const {
  if (base_ < num_hardships) {
    std::ranges::copy(
        fixtures::draw(fixtures::all_hardships[base_], static_cast<int>(points.size()), order.flat, rng),
        points.begin());
  } else if (base_ == num_hardships) {
    draw_span(points, rng);
  } else if (base_ == num_hardships + 1) {
    draw_twins(points, rng);
  } else {
    draw_common_corner(points, order, rng);
  }
  const Points corners = points.last(order.corners);
  for (WeightedPoint3& p : corners) p.weight = 0;
  if (change_ == Change::ulps || (change_ != Change::none && rng.below(2) == 0)) {
    for (auto& [x, w, level] : points) {
      for (double& c : x) c = one_off(c, std::ldexp(1.0, narrow.unit), rng);
      w = one_off(w, std::ldexp(1.0, 2 * narrow.unit), rng);
    }
    for (WeightedPoint3& p : corners) p.weight = 0;
  }
  if (order.flat)
    for (WeightedPoint3& p : points) p.position.z() = 0;
  if (change_ == Change::low) scale(points, order.range.unit - static_cast<int>(common_unit(points)));
  if (change_ == Change::high) scale(points, order.range.top - size_of(points));
  const bool in_range = common_unit(points) >= order.range.unit && size_of(points) <= order.range.top;
  geom::ensure(in_range, "storm: a draw is out of the range");
}

}  // namespace storm
