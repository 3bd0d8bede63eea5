#include "fpo/plane/plane_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpo {

using geom::Vec2;

namespace {

void measure_spacing(PlaneDomain& domain, PlaneQuality& q) {
  const auto n = static_cast<double>(domain.num_samples());
  double sum = 0, sum2 = 0, x1 = 0, y1 = 0, xx = 0, xy = 0;
  q.delta = INFINITY;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const double spacing = domain.normalized_spacing(SiteId(i));
    const double x = std::log(domain.edge_length(SiteId(i))), y = std::log(spacing) + x;
    q.delta = std::min(q.delta, spacing);
    sum += spacing;
    sum2 += spacing * spacing;
    x1 += x;
    y1 += y;
    xx += x * x;
    xy += x * y;
  }
  q.mean_delta = sum / n;
  q.spacing_variation = std::sqrt(std::max(0.0, sum2 / n - q.mean_delta * q.mean_delta)) / q.mean_delta;
  const double spread = xx - x1 * x1 / n;
  if (spread > 1e-12 * n) q.grading_slope = (xy - x1 * y1 / n) / spread;
}

void measure_angles(const geom::Regular2& t, PlaneQuality& q) {
  const auto triangles = t.triangles();
  q.min_angle = 180;
  double sum = 0;
  for (const auto& corner : triangles) {
    double least = 180;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = t.difference(corner[k], corner[(k + 1) % 3]),
                 b = t.difference(corner[k], corner[(k + 2) % 3]);
      const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180 / std::numbers::pi;
      least = std::min(least, angle);
      q.max_angle = std::max(q.max_angle, angle);
      q.angles_below_30 += angle < 30;
    }
    q.min_angle = std::min(q.min_angle, least);
    sum += least;
  }
  q.mean_min_angle = sum / static_cast<double>(triangles.size());
}

}  // namespace

PlaneQuality plane_quality(PlaneDomain& domain) {
  PlaneQuality q;
  measure_spacing(domain, q);
  measure_angles(domain.triangulation(), q);
  q.hidden = domain.num_hidden();
  return q;
}

}  // namespace fpo
