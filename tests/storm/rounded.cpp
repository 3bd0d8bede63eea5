#include <algorithm>

#include "geom/power/construct.h"
#include "tests/storm/scene.h"

namespace storm {
namespace {

double extent_of(std::span<const WeightedPoint3> points) {
  double extent = 0;
  for (const WeightedPoint3& q : points) extent = std::max(extent, q.position.lpNorm<Eigen::Infinity>());
  return extent;
}

/// Weights of some of the points, which place the exact corner.
using Shares = std::span<const Wide>;

/// Is every coordinate of the exact corner, sum of share times corner by sum of shares, within the tolerance?
/// `corners`: as many as shares.
bool within(const geom::RoundedPoint& rounded, std::span<const WeightedPoint3> corners, Shares shares) {
  if (std::isinf(rounded.tolerance)) return true;
  std::array<WeightedPoint3, 5> all;
  std::ranges::copy(corners, all.begin());
  const std::size_t n = corners.size();
  all[n].position = rounded.position;
  all[n + 1].position = {rounded.tolerance, 0, 0};
  const long unit = common_unit(std::span<const WeightedPoint3>(all).first(n + 2));
  Wide total;
  for (const Wide& share : shares) total = total + share;
  const Wide zero = Wide(),
             allowed = Wide(rounded.tolerance, unit) * (total.sign() < 0 ? zero - total : total);
  for (int k = 0; k < 3; ++k) {
    Wide off = zero - Wide(rounded.position[k], unit) * total;
    for (std::size_t i = 0; i < n; ++i) off = off + Wide(corners[i].position[k], unit) * shares[i];
    if ((off - allowed).sign() > 0 || (off + allowed).sign() < 0) return false;
  }
  return true;
}

}  // namespace

Answer ask_rounded_on_edge(const Kind& kind, const Range& range, bool, Rng& rng) {
  const Scene<2, 2, false> s(kind, range, rng);
  const Wide fa = power_difference(s.x[2], s.x[0], s.x[1]), fb = power_difference(s.x[3], s.x[0], s.x[1]);
  if (fa.sign() * fb.sign() >= 0) return not_asked;
  const double extent = extent_of(s.p);
  const geom::Bisector b = geom::bisector(s.p[0], s.p[1], extent);
  const auto rounded = geom::corner_on_edge(s.at(2), s.at(3), b(s.at(2)), b(s.at(3)), b.error, extent);
  const std::span<const WeightedPoint3> corners = std::span(s.p).template last<2>();
  const std::array<Wide, 2> shares{fb, Wide() - fa};
  s.expect(within(rounded, corners, shares), "corner_on_edge");
  s.expect(
      within(geom::exact_corner_on_edge(s.at(2), s.at(3), s.site(0), s.site(1), extent), corners, shares),
      "exact_corner_on_edge");
  return {true, std::isinf(rounded.tolerance), false};
}

Answer ask_rounded_in_facet(const Kind& kind, const Range& range, bool, Rng& rng) {
  const Scene<3, 3, false> s(kind, range, rng);
  std::array<Wide, 3> f, g, lambda;
  for (std::size_t i = 0; i < 3; ++i) {
    f[i] = power_difference(s.x[3 + i], s.x[0], s.x[1]);
    g[i] = power_difference(s.x[3 + i], s.x[0], s.x[2]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    lambda[i] = f[j] * g[k] - f[k] * g[j];
  }
  const int side = (lambda[0] + lambda[1] + lambda[2]).sign();
  for (const Wide& l : lambda)
    if (side == 0 || l.sign() == -side) return not_asked;
  const double extent = extent_of(s.p);
  const geom::LinearForm first =
      geom::linear_form(geom::bisector(s.p[0], s.p[1], extent), s.at(3), s.at(4), s.at(5));
  const geom::LinearForm second =
      geom::linear_form(geom::bisector(s.p[0], s.p[2], extent), s.at(3), s.at(4), s.at(5));
  const auto rounded =
      geom::corner_in_facet(s.at(3), s.at(4), s.at(5), geom::axis_minors(first, second), extent);
  const std::span<const WeightedPoint3> corners = std::span(s.p).template last<3>();
  s.expect(within(rounded, corners, lambda), "corner_in_facet");
  s.expect(
      within(geom::exact_corner_in_facet(s.at(3), s.at(4), s.at(5), s.site(0), s.site(1), s.site(2), extent),
             corners, lambda),
      "exact_corner_in_facet");
  return {true, std::isinf(rounded.tolerance), false};
}

}  // namespace storm
