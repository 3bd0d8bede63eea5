#include "fpo/baselines/ccst.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fpo/baselines/first_samples.h"
#include "fpo/baselines/iterations.h"
#include "fpo/baselines/voronoi_facets.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetPolygon;
using geom::Vec3;

namespace {

constexpr double largest_step = 0.5;  // in units of h

using Triangle = std::array<SiteId, 3>;  ///< counterclockwise

class AreaEqualizer {
 public:
  explicit AreaEqualizer(const BaselineTask& task)
      : task_(task), tree_(task.surface), facets_(task.surface, task.threads), samples_(first_samples(task)) {
    triangulate();
  }

  const std::vector<SurfaceSample>& samples() const { return samples_; }
  std::size_t num_triangles() const { return triangles_.size(); }

  /// The standard deviation of the capacities over their mean; infinite without triangles.
  double variation() const {
    double sum = 0, squares = 0;
    for (const Triangle& t : triangles_) {
      const double c = capacity(t);
      sum += c, squares += c * c;
    }
    const double n = static_cast<double>(triangles_.size());
    if (!(sum > 0)) return std::numeric_limits<double>::infinity();
    return std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0)) / (sum / n);
  }

  /// Both steps once. Returns how many samples moved.
  std::size_t iterate() {
    std::size_t moved = 0;
    mean_ = mean_capacity();
    for (std::size_t i = task_.fixed.size(); i < samples_.size(); ++i) moved += relax(SiteId(i));
    triangulate();
    return moved;
  }

 private:
  const Vec3& position(SiteId i) const { return samples_[i.index()].position; }
  double density(SiteId i) const {
    const double h = task_.sizing.at(samples_[i.index()]);
    return task_.sizing.is_uniform() ? 1 : 1 / (h * h);
  }
  double density(const Triangle& t) const { return (density(t[0]) + density(t[1]) + density(t[2])) / 3; }
  double capacity(const Triangle& t) const {
    const Vec3 &a = position(t[0]), &b = position(t[1]), &c = position(t[2]);
    return density(t) * (b - a).cross(c - a).norm() / 2;
  }
  double mean_capacity() const {
    double sum = 0;
    for (const Triangle& t : triangles_) sum += capacity(t);
    return sum / static_cast<double>(std::max<std::size_t>(triangles_.size(), 1));
  }

  /// The dual of the restricted Voronoi diagram, as in extract.h.
  void triangulate() {
    const auto pieces =
        facets_.pieces<Triangle>(samples_, [](const FacetPolygon& polygon, std::vector<Triangle>& out) {
          for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
            const geom::EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
            if (before.is_site() && after.is_site() && polygon.owner < before.site() &&
                polygon.owner < after.site() && before.site() != after.site())
              out.push_back({polygon.owner, before.site(), after.site()});
          }
        });
    triangles_.clear();
    for (const std::vector<Triangle>& of_lane : pieces)
      triangles_.insert(triangles_.end(), of_lane.begin(), of_lane.end());
    std::ranges::sort(triangles_);
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    of_sample_.assign(samples_.size(), {});
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (const SiteId i : triangles_[t]) of_sample_[i.index()].push_back(t);
  }

  double local_energy(SiteId i) const {
    double sum = 0;
    for (const std::size_t t : of_sample_[i.index()]) {
      const double excess = capacity(triangles_[t]) - mean_;
      sum += excess * excess;
    }
    return sum;
  }

  /// The step in the tangent plane that has the least V there, to the second order.
  Vec3 best_step(SiteId i) const {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Vec3 gradient = Vec3::Zero(), normal = Vec3::Zero();
    for (const std::size_t k : of_sample_[i.index()]) {
      const Triangle& t = triangles_[k];
      const std::size_t at = t[0] == i ? 0 : t[1] == i ? 1 : 2;
      const Vec3 &x = position(i), &p = position(t[(at + 1) % 3]), &q = position(t[(at + 2) % 3]);
      const Vec3 cross = (p - x).cross(q - x);
      const double size = cross.norm();
      if (!(size > 0)) continue;
      const Vec3 slope = density(t) * (cross / size).cross(q - p) / 2;
      normal += cross;
      hessian += slope * slope.transpose();
      gradient += slope * (capacity(t) - mean_);
    }
    if (!(normal.norm() > 0)) return Vec3::Zero();
    const Vec3 u = normal.unitOrthogonal(), w = normal.normalized().cross(u);
    const double uu = u.dot(hessian * u), uw = u.dot(hessian * w), ww = w.dot(hessian * w);
    const double determinant = uu * ww - uw * uw, gu = u.dot(gradient), gw = w.dot(gradient);
    if (!(determinant > 1e-9 * (uu + ww) * (uu + ww))) return Vec3::Zero();
    return (-(ww * gu - uw * gw) * u - (uu * gw - uw * gu) * w) / determinant;
  }

  /// Whether the sample moved.
  bool relax(SiteId i) {
    Vec3 step = best_step(i);
    const SurfaceSample before = samples_[i.index()];
    const double energy = local_energy(i), length = step.norm(),
                 most = largest_step * task_.sizing.at(before);
    if (!(length > 0)) return false;
    if (length > most) step *= most / length;
    const geom::AabbTree::Closest closest = tree_.closest(before.position + step, before.facet);
    samples_[i.index()] = {geom::snapped(closest.point), closest.facet};
    if (local_energy(i) < energy) return true;
    samples_[i.index()] = before;
    return false;
  }

  const BaselineTask& task_;
  geom::AabbTree tree_;
  VoronoiFacets facets_;
  std::vector<SurfaceSample> samples_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::size_t>> of_sample_;
  double mean_ = 0;
};

}  // namespace

BaselineResult capacity_constrained_triangulation(const BaselineTask& task, const OptimizeOptions& options) {
  const Stopwatch watch;
  AreaEqualizer equalizer(task);
  BaselineResult result;
  double least = std::numeric_limits<double>::infinity();
  const auto keep_if_best = [&] {
    const double variation = equalizer.variation();
    if (result.samples.empty() || variation < least) result.samples = equalizer.samples(), least = variation;
  };
  keep_if_best();
  IteratedMethod method;
  method.step = [&](int) {
    const std::size_t moved = equalizer.iterate();
    keep_if_best();
    return std::optional(moved);
  };
  method.samples = [&] { return std::span<const SurfaceSample>(result.samples); };
  result.run = iterate(task, options, method, watch);
  result.reached.push_back({"triangle_cv", least});
  return result;
}

}  // namespace fpo
