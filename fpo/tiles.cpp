#include "fpo/tiles.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geom/rng.h"

namespace fpo {
namespace {

using geom::Box3;
using geom::FacetId;
using geom::SiteId;
using geom::Vec3;

constexpr double least_share = 0.3;  // of the samples below a cut; above it likewise

/// Uniformly distributed: a random unit quaternion.
Frame random_frame(geom::Rng& rng) {
  for (;;) {
    const Eigen::Quaterniond q(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1),
                               rng.uniform(-1, 1));
    if (q.squaredNorm() > 0.01 && q.squaredNorm() < 1) return q.normalized().toRotationMatrix();
  }
}

class Tiling {
 public:
  Tiling(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples, const TilingOptions& options)
      : mesh_(mesh),
        samples_(samples),
        most_samples_(options.most_samples),
        rng_(options.seed),
        frame_(random_frame(rng_)) {}

  std::vector<Tile> take() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Tile all;
    all.frame = frame_;
    all.box = Box3(Vec3::Constant(-infinity), Vec3::Constant(infinity));
    for (std::size_t i = 0; i < samples_.size(); ++i) all.samples.emplace_back(i);
    for (std::size_t t = 0; t < mesh_.num_facets(); ++t) all.facets.emplace_back(t);
    cut(std::move(all));
    return std::move(tiles_);
  }

 private:
  void cut(Tile tile) {
    Box3 box;
    for (const SiteId x : tile.samples) {
      tile.sample_box.extend(position(x));
      box.extend(in_frame(frame_, position(x)));
    }
    int axis = 0;
    if (tile.samples.size() <= most_samples_ || !(box.sizes().maxCoeff(&axis) > 0)) {
      tiles_.push_back(std::move(tile));
      return;
    }
    const double plane = plane_through(tile, axis, box.min()[axis]);
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
    cut(std::move(lower));
    cut(std::move(upper));
  }

  /// Above the smallest coordinate, so that no part is empty.
  double plane_through(const Tile& tile, int axis, double least) {
    std::vector<double> coordinates;
    for (const SiteId x : tile.samples) coordinates.push_back(coordinate(position(x), axis));
    const double share = rng_.uniform(least_share, 1 - least_share);
    const auto middle =
        coordinates.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(coordinates.size()));
    std::nth_element(coordinates.begin(), middle, coordinates.end());
    if (*middle > least) return *middle;
    double next = std::numeric_limits<double>::infinity();
    for (const double c : coordinates)
      if (c > least) next = std::min(next, c);
    return next;
  }

  double coordinate(const Vec3& x, int axis) const { return in_frame(frame_, x)[axis]; }
  const Vec3& position(SiteId x) const { return samples_[x.index()].position; }

  const geom::TriMesh& mesh_;
  std::span<const SurfaceSample> samples_;
  std::size_t most_samples_;
  geom::Rng rng_;
  Frame frame_;
  std::vector<Tile> tiles_;
};

}  // namespace

std::vector<Tile> make_tiles(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const TilingOptions& options) {
  return Tiling(mesh, samples, options).take();
}

}  // namespace fpo
