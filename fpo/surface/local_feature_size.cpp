#include "fpo/surface/local_feature_size.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "fpo/surface/surface_cover.h"
#include "geom/check.h"
#include "geom/hilbert.h"
#include "geom/parallel.h"
#include "geom/regular/regular3.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"

namespace fpo {

using geom::Box3;
using geom::Regular3;
using geom::SiteId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// A tetrahedron with less volume, in units of its longest edge cubed, is a product of rounding.
constexpr double flat = 1e-10;
/// Cosine between normals of surfaces that face each other or away from each other.
constexpr double opposed = -0.5;
/// Sine of the angle between a surface and a chord that leaves it: of a ball with the least angle of 60
/// degrees 0.5, of one at a square crease 0.71, of one between plates 1, all less the sampling.
constexpr double not_flat = 0.3, steep = 0.8;
/// Sides of the cells of the grids that thin the poles out.
constexpr double cells_in_gap = 8, cells_in_radius = 32;

/// A Voronoi vertex: the center of the ball through the corners of a tetrahedron.
struct Ball {
  Vec3 center;
  double radius = 0;  ///< 0: unknown, the tetrahedron is too flat
  bool small = false;
  bool counts = false;  ///< if it is a pole or small
};

/// Computed from differences: off by about the rounding of the corners' coordinates over the tetrahedron's
/// flatness.
Ball circumscribed_ball(const std::array<Vec3, 4>& corner) {
  const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], c = corner[3] - corner[0];
  const Vec3 ab = a.cross(b), bc = b.cross(c), ca = c.cross(a);
  const double det = a.dot(bc);
  const double longest2 = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
  if (!(std::abs(det) > flat * longest2 * std::sqrt(longest2))) return {};
  const Vec3 to_center = (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab) / (2 * det);
  return {corner[0] + to_center, to_center.norm()};
}

double chord_per_radius(double degrees) { return 2 * std::sin(degrees * std::numbers::pi / 360); }

/// The Voronoi diagram of the surface points, and which of its vertices belong to the medial axis.
class VoronoiBalls {
 public:
  VoronoiBalls(std::vector<CoverPoint> points, const LocalFeatureSizeOptions& options);
  std::vector<MedialPoint> medial() const;

 private:
  using Corners = Regular3::Simplex;

  Regular3 triangulate() const;
  bool spans(const Ball& ball, const CoverPoint& p, const CoverPoint& q) const;
  void judge(const Corners& cell, Ball& ball) const;
  std::vector<bool> poles() const;

  std::vector<CoverPoint> points_;  ///< by site
  LocalFeatureSizeOptions options_;
  double chord_per_radius_, chord_per_radius_within_facets_;
  std::vector<Corners> cells_;
  std::vector<Ball> balls_;  ///< by cell
};

VoronoiBalls::VoronoiBalls(std::vector<CoverPoint> points, const LocalFeatureSizeOptions& options)
    : points_(std::move(points)),
      options_(options),
      chord_per_radius_(chord_per_radius(options.min_angle)),
      chord_per_radius_within_facets_(chord_per_radius(options.min_angle_within_facets)) {
  const Regular3 triangulation = triangulate();
  cells_ = triangulation.simplices();
  balls_.resize(cells_.size());
  geom::parallel_ranges(cells_.size(), 4096, options.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const Corners& cell = cells_[k];
      std::array<Vec3, 4> corner;
      std::ranges::transform(cell, corner.begin(), [&](SiteId s) { return triangulation.point(s).position; });
      balls_[k] = circumscribed_ball(corner);
      if (balls_[k].radius > 0 && std::ranges::none_of(cell, &geom::is_guard)) judge(cell, balls_[k]);
    }
  });
}

/// Rounds of random points, each several times as many as those before it together, lest the points be all on
/// one side of the surface that is still missing; in a round along a space-filling curve, so that each finds
/// the one before it nearby (Amenta, Choi, Rote, Incremental constructions con BRIO, 2003).
std::vector<std::uint32_t> insertion_order(const std::vector<Vec3>& positions, const Box3& box,
                                           std::uint64_t seed) {
  geom::Rng rng(seed);
  std::vector<int> round;
  for (std::size_t i = 0; i < positions.size(); ++i) round.push_back(-std::countr_zero(rng.bits()) / 3);
  std::vector<std::uint32_t> order = geom::hilbert_order(positions, box);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return round[i]; });
  return order;
}

Regular3 VoronoiBalls::triangulate() const {
  std::vector<Vec3> positions;
  Box3 box;
  for (const CoverPoint& p : points_) {
    positions.push_back(p.position);
    box.extend(p.position);
  }
  Regular3 triangulation(box);
  SiteId previous;
  for (const std::uint32_t i : insertion_order(positions, box, options_.seed)) {
    const SiteId id(static_cast<std::size_t>(i));
    triangulation.insert(id, {positions[i], 0.0}, previous);
    if (!triangulation.is_hidden(id)) previous = id;
  }
  return triangulation;
}

/// Whether the ball is one of the medial axis as far as two of its corners tell: far apart, seen from the
/// center, and the chord between them leaves the surface at both ends, as it cannot where the ball fills a
/// hole between surface points. If the ball is small, on opposed pieces of surface as well.
bool VoronoiBalls::spans(const Ball& ball, const CoverPoint& p, const CoverPoint& q) const {
  const bool within_facets = ball.radius < std::min(p.facet_edge, q.facet_edge);
  const Vec3 chord = q.position - p.position;
  const double length = chord.norm();
  if (length < ball.radius * (within_facets ? chord_per_radius_within_facets_ : chord_per_radius_))
    return false;
  const double steepness = std::min(std::abs(p.normal.dot(chord)), std::abs(q.normal.dot(chord))) / length;
  if (ball.small) return steepness > steep || p.normal.dot(q.normal) < opposed;
  return steepness > not_flat;
}

void VoronoiBalls::judge(const Corners& cell, Ball& ball) const {
  double gap = options_.spacing;
  if (gap == 0)
    for (const SiteId s : cell) gap = std::max(gap, points_[s.index()].facet_edge);
  ball.small = ball.radius < options_.min_radius * gap;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      ball.counts |= spans(ball, points_[cell[i].index()], points_[cell[j].index()]);
}

/// By ball, whether it is a pole: of one of its corners the farthest Voronoi vertex, or the farthest of those
/// on the other side. Vertices dual to tetrahedra with a guard stand for infinity: they are the farthest of
/// points on the hull, but count nowhere.
std::vector<bool> VoronoiBalls::poles() const {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::array<std::size_t, 2>> pole(points_.size(), {none, none});
  for (const std::size_t side : {0, 1}) {
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      if (!(balls_[k].radius > 0)) continue;
      for (const SiteId s : cells_[k]) {
        if (geom::is_guard(s)) continue;
        auto& best = pole[s.index()];
        const Vec3& x = points_[s.index()].position;
        if (side == 1 && (balls_[k].center - x).dot(balls_[best[0]].center - x) >= 0) continue;
        if (best[side] == none || balls_[k].radius > balls_[best[side]].radius) best[side] = k;
      }
    }
  }
  std::vector<bool> is_pole(balls_.size(), false);
  for (const auto& sides : pole)
    for (const std::size_t k : sides)
      if (k != none) is_pole[k] = true;
  return is_pole;
}

std::vector<MedialPoint> VoronoiBalls::medial() const {
  const std::vector<bool> is_pole = poles();
  std::vector<MedialPoint> result;
  for (std::size_t k = 0; k < balls_.size(); ++k)
    if (balls_[k].counts && (balls_[k].small || is_pole[k]))
      result.push_back({balls_[k].center, balls_[k].radius});
  return result;
}

/// Keeps one of the points in each cell of a grid, the one with the largest ball: a sphere would give one
/// point thousands of times. The grid is coarser for larger balls, which are empty of surface: all distances
/// to such a point are at least as large.
std::vector<MedialPoint> thinned(const std::vector<MedialPoint>& points, double finest) {
  using Key = std::array<double, 4>;
  std::vector<std::pair<Key, std::size_t>> keyed;
  for (const MedialPoint& p : points) {
    const double cell = std::max(finest, std::exp2(std::floor(std::log2(p.radius / cells_in_radius))));
    const Vec3 key = (p.position / cell).array().floor();
    keyed.emplace_back(Key{cell, key.x(), key.y(), key.z()}, keyed.size());
  }
  std::ranges::sort(keyed, [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const double of_a = points[a.second].radius, of_b = points[b.second].radius;
    return of_a != of_b ? of_a > of_b : a.second < b.second;
  });
  std::vector<MedialPoint> kept;
  for (std::size_t i = 0; i < keyed.size(); ++i)
    if (i == 0 || keyed[i].first != keyed[i - 1].first) kept.push_back(points[keyed[i].second]);
  return kept;
}

/// The power of two that brings the largest coordinate into [1/2, 1): no product in a predicate over- or
/// underflows then.
double scale_to_unit(const std::vector<CoverPoint>& points) {
  double largest = 0;
  for (const CoverPoint& p : points) largest = std::max(largest, p.position.lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, -exponent);
}

}  // namespace

std::vector<MedialPoint> medial_points(const TriMesh& mesh, const LocalFeatureSizeOptions& options) {
  geom::require(options.min_radius >= 0 && std::isfinite(options.min_radius),
                "the least radius of a pole's ball must be a finite number, at least 0");
  for (const double angle : {options.min_angle, options.min_angle_within_facets})
    geom::require(angle >= 0 && angle < 180, "the least angle at a pole must be in [0, 180) degrees");
  std::vector<CoverPoint> points = surface_cover(mesh, options.spacing, options.seed);
  if (points.size() < 4) return {};
  const double scale = scale_to_unit(points);
  LocalFeatureSizeOptions scaled = options;
  scaled.spacing *= scale;
  double mean_edge = 0;
  for (CoverPoint& p : points) {
    p.position *= scale;
    p.facet_edge *= scale;
    mean_edge += p.facet_edge / static_cast<double>(points.size());
  }
  const double gap = scaled.spacing > 0 ? scaled.spacing : mean_edge;
  std::vector<MedialPoint> result =
      thinned(VoronoiBalls(std::move(points), scaled).medial(), gap / cells_in_gap);
  for (MedialPoint& m : result) {
    m.position /= scale;
    m.radius /= scale;
  }
  return result;
}

std::vector<double> local_feature_size(std::span<const Vec3> locations, std::span<const MedialPoint> medial,
                                       int threads) {
  geom::SiteTree tree;
  for (std::size_t i = 0; i < medial.size(); ++i) tree.insert(SiteId(i), {medial[i].position, 0.0});
  std::vector<double> size(locations.size());
  geom::parallel_ranges(size.size(), 512, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      size[i] = std::sqrt(tree.nearest(locations[i], SiteId()).radius2);
  });
  return size;
}

Table<VertexId, double> local_feature_size(const TriMesh& mesh, const LocalFeatureSizeOptions& options) {
  const std::span vertices(mesh.vertices().data(), mesh.num_vertices());
  const std::vector<double> size =
      local_feature_size(vertices, medial_points(mesh, options), options.threads);
  return Table<VertexId, double>(size.begin(), size.end());
}

}  // namespace fpo
