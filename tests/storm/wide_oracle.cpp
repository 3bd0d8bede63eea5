#include "tests/storm/wide_oracle.h"

#include <algorithm>
#include <array>
#include <vector>

namespace storm {
namespace {

Wide minor(const Wide& a, const Wide& b, const Wide& c, const Wide& d) { return a * b - c * d; }

/// Three numbers: a row of a matrix.
struct Row {
  Wide x, y, z;
};

Row difference(const WideSite& a, const WideSite& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Row cross(const Row& a, const Row& b) {
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}
Wide dot(const Row& a, const Row& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Wide determinant(const Row& a, const Row& b, const Row& c) { return dot(cross(a, b), c); }

/// |p - a|^2 - (w_p - w_a)
Wide lift(const WideSite& p, const WideSite& a) {
  const Row d = difference(p, a);
  return dot(d, d) - (p.weight - a.weight);
}

/// The sign of an affine function of the weights, perturbed: where it vanishes, the smallest rank whose
/// weights change it decides.
template <std::size_t N, class Value>
Decision decide(std::span<const WideSite, N> sites, const Value& value) {
  if (const int sign = value(sites).sign(); sign != 0) return {sign, false};
  std::array<int, N> ranks;
  std::ranges::transform(sites, ranks.begin(), &WideSite::rank);
  std::ranges::sort(ranks);
  for (const int rank : ranks) {
    std::array<WideSite, N> heavier;
    std::ranges::copy(sites, heavier.begin());
    for (WideSite& s : heavier)
      if (s.rank == rank) s.weight = s.weight + Wide::one();
    if (const int sign = value(std::span<const WideSite, N>(heavier)).sign(); sign != 0) return {sign, true};
  }
  return {0, true};
}

}  // namespace

long common_unit(std::span<const geom::WeightedPoint3> points) {
  long unit = 1L << 20;
  for (const geom::WeightedPoint3& p : points) {
    for (const double x : p.position) unit = std::min(unit, lowest_bit(x));
    const long of_weight = lowest_bit(p.weight);
    unit = std::min(unit, of_weight >= 0 ? of_weight / 2 : -((1 - of_weight) / 2));
  }
  return unit == 1L << 20 ? 0 : std::min(unit, 2000L);
}

Wide power_difference(const WideSite& q, const WideSite& i, const WideSite& j) {
  const Row di = difference(q, i), dj = difference(q, j);
  return (dot(dj, dj) - j.weight) - (dot(di, di) - i.weight);
}

int orient2(const WideSite& a, const WideSite& b, const WideSite& c) {
  const Row u = difference(b, a), v = difference(c, a);
  return minor(u.x, v.y, u.y, v.x).sign();
}

int orient3(const WideSite& a, const WideSite& b, const WideSite& c, const WideSite& d) {
  return determinant(difference(b, a), difference(c, a), difference(d, a)).sign();
}

// The height of the lifted point e over the plane of the others.
Decision power_side2(std::span<const WideSite, 4> sites) {
  return decide(sites, [](std::span<const WideSite, 4> p) {
    std::array<Row, 3> rows;
    for (std::size_t i = 0; i < 3; ++i)
      rows[i] = {p[i + 1].x - p[0].x, p[i + 1].y - p[0].y, lift(p[i + 1], p[0])};
    return determinant(rows[0], rows[1], rows[2]);
  });
}

Decision power_side3(std::span<const WideSite, 5> sites) {
  return decide(sites, [](std::span<const WideSite, 5> p) {
    std::array<Row, 4> row;
    std::array<Wide, 4> height;
    for (std::size_t i = 0; i < 4; ++i) {
      row[i] = difference(p[i + 1], p[0]);
      height[i] = lift(p[i + 1], p[0]);
    }
    const Row c01 = cross(row[0], row[1]), c23 = cross(row[2], row[3]);
    return (height[3] * dot(c01, row[2]) - height[2] * dot(c01, row[3])) +
           (height[1] * dot(c23, row[0]) - height[0] * dot(c23, row[1]));
  });
}

Decision at_vertex(const WideSite& q, std::span<const WideSite, 2> sites) {
  return decide(sites, [&](std::span<const WideSite, 2> p) { return power_difference(q, p[0], p[1]); });
}

Decision on_edge(const WideSite& a, const WideSite& b, std::span<const WideSite, 3> sites) {
  const int side = (power_difference(b, sites[0], sites[1]) - power_difference(a, sites[0], sites[1])).sign();
  if (side == 0) return {0, false};
  Decision decision = decide(sites, [&](std::span<const WideSite, 3> p) {
    return minor(power_difference(b, p[0], p[1]), power_difference(a, p[0], p[2]),
                 power_difference(a, p[0], p[1]), power_difference(b, p[0], p[2]));
  });
  decision.sign *= side;
  return decision;
}

Decision in_facet(std::span<const WideSite, 3> q, std::span<const WideSite, 4> sites) {
  const auto row = [&](const WideSite& owner, const WideSite& j) -> Row {
    return {power_difference(q[0], owner, j), power_difference(q[1], owner, j),
            power_difference(q[2], owner, j)};
  };
  const Row lambda = cross(row(sites[0], sites[1]), row(sites[0], sites[2]));
  const int side = (lambda.x + lambda.y + lambda.z).sign();
  if (side == 0) return {0, false};
  Decision decision = decide(sites, [&](std::span<const WideSite, 4> p) {
    return determinant(row(p[0], p[1]), row(p[0], p[2]), row(p[0], p[3]));
  });
  decision.sign *= side;
  return decision;
}

}  // namespace storm
