#include "fpo/tiles/tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geom/check.h"
#include "geom/rng.h"

namespace fpo {
namespace {

using geom::Box3;
using geom::FacetId;
using geom::SiteId;
using geom::Vec3;

constexpr double least_share = 0.4;  // of the samples below a cut; above it likewise
constexpr int num_tries = 16;

/// Of a sample at this coordinate.
struct Toll {
  double at;
  CutCost toll;
};

/// Uniformly distributed: a random unit quaternion.
Frame random_frame(geom::Rng& rng) {
  for (;;) {
    // Drawn one after the other: the order of arguments is the compiler's choice.
    const double z = rng.uniform(-1, 1), y = rng.uniform(-1, 1), x = rng.uniform(-1, 1),
                 w = rng.uniform(-1, 1);
    const Eigen::Quaterniond q(w, x, y, z);
    if (q.squaredNorm() > 0.01 && q.squaredNorm() < 1) return q.normalized().toRotationMatrix();
  }
}

class Tiling {
 public:
  Tiling(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples, const TilingOptions& options)
      : mesh_(mesh),
        samples_(samples),
        most_samples_(options.most_samples),
        cut_costs_(options.cut_costs),
        rng_(options.seed),
        frame_(random_frame(rng_)) {}

  std::vector<Tile> take() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Tile all;
    all.frame = frame_;
    all.box = Box3(Vec3::Constant(-infinity), Vec3::Constant(infinity));
    for (std::size_t i = 0; i < samples_.size(); ++i) all.samples.emplace_back(i);
    for (std::size_t t = 0; t < mesh_.num_facets(); ++t) all.facets.emplace_back(t);
    int times = 0;
    for (std::size_t parts = 1; samples_.size() > parts * most_samples_; parts *= 2) ++times;
    cut(std::move(all), times);
    return std::move(tiles_);
  }

 private:
  /// At least so many times one after the other, so that tiles are alike.
  void cut(Tile tile, int times) {
    Box3 box;
    for (const SiteId x : tile.samples) {
      tile.sample_box.extend(position(x));
      box.extend(in_frame(frame_, position(x)));
    }
    int axis = 0;
    if ((times <= 0 && tile.samples.size() <= most_samples_) || !(box.sizes().maxCoeff(&axis) > 0)) {
      tiles_.push_back(std::move(tile));
      return;
    }
    const double plane = cheapest_plane(tile, axis);
    Tile lower, upper;
    lower.box = upper.box = tile.box;
    lower.frame = upper.frame = frame_;
    lower.box.max()[axis] = upper.box.min()[axis] = plane;
    for (const SiteId x : tile.samples)
      (coordinate(position(x), axis) < plane ? lower : upper).samples.push_back(x);
    for (const FacetId t : tile.facets) {
      const auto [least, most] =
          std::minmax({coordinate(mesh_.corner(t, 0), axis), coordinate(mesh_.corner(t, 1), axis),
                       coordinate(mesh_.corner(t, 2), axis)});
      if (least <= plane) lower.facets.push_back(t);
      if (most >= plane) upper.facets.push_back(t);
    }
    tile = Tile();
    cut(std::move(lower), times - 1);
    cut(std::move(upper), times - 1);
  }

  /// A cut that is cheap of so many.
  double cheapest_plane(const Tile& tile, int axis) {
    std::vector<double> coordinates;
    std::vector<Toll> tolls;
    for (const SiteId x : tile.samples) {
      coordinates.push_back(coordinate(position(x), axis));
      if (cut_costs_.empty()) continue;
      const CutCost& c = cut_costs_[x.index()];
      if (c.cost > 0) tolls.push_back({coordinates.back(), c});
    }
    std::ranges::sort(coordinates);
    const auto cost_of = [&](double plane) {
      double cost = 0;
      for (const auto& [at, toll] : tolls)
        if (std::abs(at - plane) < toll.within) cost += toll.cost;
      return cost;
    };
    double best = random_plane(coordinates), least_cost = cost_of(best);
    for (int i = 1; i < num_tries && least_cost > 0; ++i) {
      const double plane = random_plane(coordinates), cost = cost_of(plane);
      if (cost >= least_cost) continue;
      best = plane;
      least_cost = cost;
    }
    return best;
  }

  /// Above the smallest of the ascending coordinates, so that no part is empty.
  double random_plane(std::span<const double> coordinates) {
    const double share = rng_.uniform(least_share, 1 - least_share);
    const double middle =
        coordinates[static_cast<std::size_t>(share * static_cast<double>(coordinates.size()))];
    if (middle > coordinates.front()) return middle;
    return *std::ranges::upper_bound(coordinates, middle);
  }

  double coordinate(const Vec3& x, int axis) const { return in_frame(frame_, x)[axis]; }
  const Vec3& position(SiteId x) const { return samples_[x.index()].position; }

  const geom::TriMesh& mesh_;
  std::span<const SurfaceSample> samples_;
  std::size_t most_samples_;
  std::span<const CutCost> cut_costs_;
  geom::Rng rng_;
  Frame frame_;
  std::vector<Tile> tiles_;
};

}  // namespace

std::vector<Tile> make_tiles(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const TilingOptions& options) {
  geom::ensure(options.cut_costs.empty() || options.cut_costs.size() == samples.size(),
               "tiles: there must be one cost a sample");
  return Tiling(mesh, samples, options).take();
}

}  // namespace fpo
