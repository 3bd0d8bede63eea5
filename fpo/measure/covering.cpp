#include "fpo/measure/covering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/power/restricted_power.h"
#include "geom/sites/nearest_distances.h"
#include "geom/sites/site_tree.h"

namespace fpo {

using geom::FacetId;
using geom::FragmentId;
using geom::SiteId;
using geom::Vec3;
using geom::WeightedPoint3;

namespace {

constexpr int most_steps = 60;  // five or six are usual

/// Calls visit(corner, power) for each corner of the diagram of which the power is more than visit returns.
template <class Visit>
void for_each_gap(const geom::TriMesh& surface, std::span<const WeightedPoint3> points, double above,
                  int threads, const Visit& visit) {
  geom::SiteTree tree;
  for (std::size_t i = 0; i < points.size(); ++i) tree.insert(SiteId(i), points[i]);
  const geom::RestrictedPower diagram(surface, points, tree, threads);
  const geom::FragmentStore& fragments = diagram.fragments();
  std::array<geom::PolygonCorner, 3> buffer;
  for (FacetId t(0); t.index() < surface.num_facets(); t = FacetId(t.value + 1))
    for (const FragmentId f : fragments.of_facet(t)) {
      if (fragments.max_radius2(f) <= above) continue;
      for (const geom::PolygonCorner& corner : fragments.corners(f, buffer)) {
        const double power = geom::power(corner.point.position, diagram.site(fragments.site(f)));
        if (power > above) above = visit(Gap{geom::snapped(corner.point.position), t, power});
      }
    }
}

Gap largest_gap(const geom::TriMesh& surface, const std::vector<WeightedPoint3>& points, int threads) {
  Gap largest;
  for_each_gap(surface, points, largest.power, threads, [&](const Gap& gap) {
    largest = gap;
    return gap.power;
  });
  return largest;
}

double least_ratio(const Vec3& x, std::span<const Vec3> samples, std::span<const double> sizes) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (sizes[i] > 0) least = std::min(least, (x - samples[i]).norm() / sizes[i]);
  return least;
}

std::vector<WeightedPoint3> disks(std::span<const Vec3> samples, std::span<const double> sizes,
                                  double factor) {
  std::vector<WeightedPoint3> points;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double radius = factor * sizes[i];
    points.push_back(
        {samples[i], geom::snapped(radius * radius, geom::coordinate_unit * geom::coordinate_unit)});
  }
  return points;
}

}  // namespace

std::vector<Gap> gaps_above(const geom::TriMesh& surface, std::span<const WeightedPoint3> points,
                            double above, int threads) {
  std::vector<Gap> result;
  for_each_gap(surface, points, above, threads, [&](const Gap& gap) {
    result.push_back(gap);
    return above;
  });
  return result;
}

std::vector<double> nearest_distances(std::span<const Vec3> samples) {
  std::vector<double> result = geom::nearest_distances(samples);
  for (double& distance : result)
    if (!std::isfinite(distance)) distance = 0;
  return result;
}

Covering covering(const geom::TriMesh& surface, std::span<const Vec3> samples, std::span<const double> sizes,
                  int threads) {
  geom::require(!samples.empty(), "there is no sample");
  const Gap plain = largest_gap(surface, disks(samples, sizes, 0), threads);
  Covering result;
  result.radius = std::sqrt(std::max(plain.power, 0.0));
  const std::vector<double> distances = nearest_distances(samples);
  const double least = *std::ranges::min_element(distances);
  if (least > 0) result.ratio = result.radius / least;
  double factor = least_ratio(plain.place, samples, sizes);
  if (!std::isfinite(factor)) return result;
  for (int step = 0; step < most_steps; ++step) {
    result.local_ratio = factor;
    const Gap gap = largest_gap(surface, disks(samples, sizes, factor), threads);
    factor = least_ratio(gap.place, samples, sizes);
    if (!(factor > result.local_ratio * (1 + 1e-9))) break;
  }
  return result;
}

}  // namespace fpo
