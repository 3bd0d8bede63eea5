#include "fpo/plane/curve_feature_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "fpo/plane/grid_sizing.h"
#include "geom/check.h"
#include "geom/regular/regular2.h"
#include "geom/sites/site_tree.h"

namespace fpo {

using geom::FlatTorus;
using geom::Regular2;
using geom::SimplexId;
using geom::Vec2;
using geom::Vec3;

namespace {

constexpr std::size_t most_points = 400'000, most_copies = 10'000'000;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The curves cut into pieces: distinct points, and which of them are the ends of one piece.
struct CutCurves {
  std::vector<Vec2> points;  ///< on the torus
  std::set<std::pair<std::size_t, std::size_t>> pieces;
};

CutCurves cut(std::span<const Polyline> curves, const FlatTorus& torus, double spacing) {
  CutCurves result;
  std::map<std::pair<double, double>, std::size_t> index;
  const auto add = [&](const Vec2& x) {
    geom::require(x.allFinite(), "a coordinate is not finite");
    const Vec2 at = torus.snap(x);
    const auto [place, is_new] = index.try_emplace({at.x(), at.y()}, result.points.size());
    if (is_new) result.points.push_back(at);
    return place->second;
  };
  for (const Polyline& curve : curves) {
    if (curve.empty()) continue;
    std::size_t last = add(curve[0]);
    for (std::size_t k = 1; k < curve.size(); ++k) {
      const double pieces = std::ceil((curve[k] - curve[k - 1]).norm() / spacing);
      geom::require(static_cast<double>(result.points.size()) + pieces <= most_points,
                    "the curves are too long: they need more than " + std::to_string(most_points) +
                        " points a distance of " + std::to_string(spacing) + " apart");
      for (double i = 1; i <= pieces; ++i) {
        const std::size_t here = add(curve[k - 1] + i / pieces * (curve[k] - curve[k - 1]));
        if (here != last) result.pieces.insert(std::minmax(last, here));
        last = here;
      }
    }
  }
  geom::require(!result.points.empty(), "there is neither a curve nor a point");
  return result;
}

/// A torus of whole copies of the given one, large enough for the triangulation of any periodic set.
struct Copies {
  // An empty circle has a radius of at most half the period's diagonal d: a larger one contains a copy of
  // whatever point there is. So edges are shorter than d, and triangles can be told from their corners if d
  // is less than half a period of the copies. From the middle copy to the border of all is more than d / 2.
  explicit Copies(const Vec2& its_period) : period(its_period) {
    for (int axis = 0; axis < 2; ++axis)
      count[static_cast<std::size_t>(axis)] =
          static_cast<std::size_t>(std::floor(2 * period.norm() / period[axis])) + 1;
  }
  Vec2 offset(std::size_t i, std::size_t j) const {
    return {static_cast<double>(i) * period.x(), static_cast<double>(j) * period.y()};
  }
  std::size_t number() const { return count[0] * count[1]; }
  Vec2 middle() const { return offset(count[0] / 2, count[1] / 2); }

  Vec2 period;
  std::array<std::size_t, 2> count;
};

Regular2 triangulate(const CutCurves& curves, const Copies& copies) {
  const std::size_t n = curves.points.size();
  geom::require(n * copies.number() <= most_copies, "the curves are too long for so oblong a torus");
  std::vector<geom::WeightedPoint2> points;
  points.reserve(n * copies.number());
  for (std::size_t i = 0; i < copies.count[0]; ++i) {
    for (std::size_t j = 0; j < copies.count[1]; ++j)
      for (const Vec2& x : curves.points) points.push_back({x + copies.offset(i, j), 0});
  }
  return Regular2(copies.offset(copies.count[0], copies.count[1]), points);
}

/// Points of the medial axis on the Voronoi edge from c to d, coordinates relative to one of the two points
/// to which the edge belongs; b is the other one.
void add_medial_points(const Vec2& b, const Vec2& c, const Vec2& d, double spacing, std::vector<Vec2>& out) {
  // Places on the bisector: the midpoint plus t times its direction. Seen from there a circle through both
  // points touches them under 60 degrees or more if its radius is at most their distance.
  const double length = b.norm();
  const Vec2 middle = b / 2, along = Vec2(-b.y(), b.x()) / length;
  const double reach = std::numbers::sqrt3 / 2 * length;
  double from = along.dot(c - middle), to = along.dot(d - middle);
  if (from > to) std::swap(from, to);
  from = std::max(from, -reach);
  to = std::min(to, reach);
  if (!(from <= to)) return;
  const double steps = std::ceil((to - from) / std::max(spacing, length / 32));
  for (double k = 0; k <= steps; ++k)
    out.push_back(middle + (steps > 0 ? from + k / steps * (to - from) : from) * along);
  if (from < 0 && to > 0) out.push_back(middle);  // the nearest to both
}

/// The medial axis as points.
class MedialAxis {
 public:
  MedialAxis(const CutCurves& curves, const Copies& copies, double spacing) {
    const Regular2 diagram = triangulate(curves, copies);
    const std::size_t n = curves.points.size();
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n * copies.number(); ++i) {
      const geom::SiteId a(i);
      if (diagram.is_hidden(a)) continue;
      const Vec2 at = diagram.point(a).position;
      diagram.visit_star(a, [&](SimplexId t, int corner) {
        // The edge from a to the corner before it; the triangle beyond is the one before t around a.
        const geom::SiteId b = diagram.corners(t)[static_cast<std::size_t>((corner + 1) % 3)];
        if (!(a < b) || curves.pieces.contains(std::minmax(i % n, b.index() % n))) return;
        const Vec2 c = diagram.torus().shortest(diagram.center(t) - at);
        const Vec2 d = diagram.torus().shortest(diagram.center(before(diagram, a, b)) - at);
        points.clear();
        add_medial_points(diagram.difference(a, b), c, d, spacing, points);
        for (const Vec2& x : points) add(at + x, spacing / 16);
      });
    }
    geom::require(number_ > 0, "the curves have no medial axis");
  }

  double distance(const Vec2& x) const {
    const auto nearest = tree_.nearest(geom::Vec3(x.x(), x.y(), 0), geom::SiteId());
    return std::sqrt(std::max(nearest.radius2, 0.0));
  }

 private:
  /// The triangle to the right of the edge from a to b.
  static SimplexId before(const Regular2& diagram, geom::SiteId a, geom::SiteId b) {
    SimplexId found;
    diagram.visit_star(a, [&](SimplexId t, int corner) {
      if (diagram.corners(t)[static_cast<std::size_t>((corner + 2) % 3)] == b) found = t;
    });
    return found;
  }
  /// One point in each cell of a grid: the center of a circle is on the axis of all its points.
  void add(const Vec2& x, double cell) {
    const Vec2 place = (x / cell).array().floor();
    if (taken_.emplace(place.x(), place.y()).second)
      tree_.insert(geom::SiteId(number_++), {{x.x(), x.y(), 0}, 0});
  }

  geom::SiteTree tree_;
  std::set<std::pair<double, double>> taken_;
  std::size_t number_ = 0;
};

}  // namespace

std::vector<CurvePoint> curve_feature_size(std::span<const Polyline> curves, const FlatTorus& torus,
                                           double spacing) {
  geom::require(spacing > 0 && std::isfinite(spacing), "the spacing of curve points must be positive");
  CutCurves pieces = cut(curves, torus, spacing);
  // From here on in units of the torus: all copies together may exceed the largest period.
  const double unit = torus.unit();
  for (Vec2& x : pieces.points) x /= unit;
  const Copies copies(torus.period() / unit);
  const MedialAxis axis(pieces, copies, spacing / unit);
  std::vector<CurvePoint> result;
  result.reserve(pieces.points.size());
  for (const Vec2& x : pieces.points) result.push_back({unit * x, unit * axis.distance(x + copies.middle())});
  return result;
}

std::unique_ptr<PlaneSizing> feature_sizing(std::span<const CurvePoint> points, const FlatTorus& torus,
                                            std::size_t num_samples, const FeatureLimits& limits) {
  constexpr double resolution = 512;
  geom::require(!points.empty(), "there is neither a curve nor a point");
  geom::require(limits.ratio >= 1 && limits.gradation > 0, "the limits of the sizing are senseless");
  const Vec2 cells = (torus.period() / torus.period().maxCoeff() * resolution).array().ceil();
  PeriodicGrid rho{static_cast<std::size_t>(cells.x()), static_cast<std::size_t>(cells.y()), {}};
  double least = infinity, most = 0;
  for (const CurvePoint& c : points) {
    least = std::min(least, c.feature_size);
    most = std::max(most, c.feature_size);
  }
  geom::require(most > 0, "the feature size is 0 everywhere");
  least = std::max(least, most / limits.ratio);
  rho.value.assign(rho.width * rho.height, least * limits.ratio);
  const auto cell_of = [](double x, double period, std::size_t count) {
    return std::min(static_cast<std::size_t>(x / period * static_cast<double>(count)), count - 1);
  };
  for (const CurvePoint& c : points) {
    double& value = rho.at(cell_of(c.position.x(), torus.period().x(), rho.width),
                           cell_of(c.position.y(), torus.period().y(), rho.height));
    value = std::min(value, std::max(c.feature_size, least));
  }
  return grid_sizing(rho, torus, num_samples, limits.gradation);
}

}  // namespace fpo
