#include "fpo/spectrum/spectrum_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fpo/spectrum/spacing_tree.h"
#include "geom/check.h"

namespace fpo {

using geom::Vec2;
using geom::Vec3;

namespace {

constexpr double hexagon = std::numbers::sqrt3 / 2;  ///< area of a sample's cell, in units of spacing^2
constexpr std::size_t neighbours_for_density = 24;
constexpr std::size_t neighbours_for_interpolation = 6;
constexpr double most_copies = 2e7;

/// Scales spacings so that the hexagons fill the area.
void fill_area(std::vector<SpectrumPoint>& samples, double area) {
  double filled = 0;
  for (const SpectrumPoint& s : samples) filled += hexagon * s.spacing * s.spacing;
  for (SpectrumPoint& s : samples) s.spacing *= std::sqrt(area / filled);
}

/// The copies of points shifted by periods that come within `margin` of the rectangle.
template <class Point, class Position>
std::vector<Point> copies_within(const std::vector<Point>& points, const Vec2& period, double margin,
                                 const Position& position) {
  const int most_x = static_cast<int>(std::ceil(margin / period.x()));
  const int most_y = static_cast<int>(std::ceil(margin / period.y()));
  const double share = (1 + 2 * margin / period.x()) * (1 + 2 * margin / period.y());
  geom::require(
      share * static_cast<double>(points.size()) < most_copies,
      "too few samples for that radius, or spacings too different: the periodic copies are too many");
  std::vector<Point> copies;
  for (int a = -most_x; a <= most_x; ++a) {
    for (int b = -most_y; b <= most_y; ++b) {
      if (a == 0 && b == 0) continue;
      for (Point p : points) {
        Vec3& x = position(p);
        x += Vec3(a * period.x(), b * period.y(), 0);
        const Vec2 at = x.head<2>();
        if ((at.array() >= -margin).all() && ((at - period).array() <= margin).all()) copies.push_back(p);
      }
    }
  }
  return copies;
}

std::vector<SpectrumPoint> copies_of_samples(const std::vector<SpectrumPoint>& samples, const Vec2& period,
                                             double margin) {
  return copies_within(samples, period, margin, [](SpectrumPoint& p) -> Vec3& { return p.position; });
}

SpacingTree tree_with(const std::vector<SpectrumPoint>& samples, const std::vector<SpectrumPoint>& copies) {
  std::vector<SpectrumPoint> all = samples;
  all.insert(all.end(), copies.begin(), copies.end());
  return SpacingTree(std::move(all));
}

/// The disk that reaches halfway (by area) from the k-th neighbour to the next has k + 1/2 of them in it, on
/// the average over random sets.
void spacings_from_density(std::vector<SpectrumPoint>& samples, const SpacingTree& tree) {
  std::vector<SpacingTree::Neighbour> near;
  std::vector<double> spacing;
  for (const SpectrumPoint& s : samples) {
    tree.nearest(s, neighbours_for_density + 2, near);  // the sample itself among them
    geom::require(near.size() > 2 && near.back().distance2 > 0,
                  "too few samples to tell their local density");
    const double area = std::numbers::pi * (near.back().distance2 + near[near.size() - 2].distance2) / 2;
    spacing.push_back(std::sqrt(area / (hexagon * (static_cast<double>(near.size()) - 1.5))));
  }
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].spacing = spacing[i];
}

template <class WeightedPoint>
void spacings_from_weights(std::vector<SpectrumPoint>& samples, std::span<const WeightedPoint> weighted) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    geom::require(weighted[i].weight > 0, "spacings by weights want every weight positive");
    samples[i].spacing = std::sqrt(weighted[i].weight);
  }
}

/// Spacings and samples to expect anywhere in the domain.
class Density {
 public:
  Density(const std::vector<SpectrumPoint>& samples, const std::vector<SpectrumPoint>& copies, bool uniform)
      : tree_(tree_with(samples, copies)), count_(static_cast<double>(samples.size())), uniform_(uniform) {}

  double count() const { return count_; }
  bool uniform() const { return uniform_; }
  /// Between samples: the mean of the nearest ones, by inverse squared distance.
  double spacing(const SpectrumPoint& x) const {
    if (uniform_) return tree_.points().front().spacing;
    std::vector<SpacingTree::Neighbour> near;
    tree_.nearest(x, neighbours_for_interpolation, near);
    if (near.empty()) return tree_.points().front().spacing;  // faces away from every sample
    double sum = 0, weights = 0;
    for (const SpacingTree::Neighbour& p : near) {
      const double spacing = tree_.points()[p.index].spacing;
      const double weight = 1 / (p.distance2 + 1e-6 * spacing * spacing);
      sum += weight * spacing;
      weights += weight;
    }
    return sum / weights;
  }
  /// The area of a piece at x in which 1 / density samples are expected.
  double piece_area(const SpectrumPoint& x, double density) const {
    const double r = spacing(x);
    return hexagon * r * r / density;
  }
  /// Pieces with their spacings and the samples to expect there, count() in all.
  std::vector<SpectrumMass> masses(const std::vector<SurfacePiece>& pieces) const {
    std::vector<SpectrumMass> all;
    double total = 0;
    for (const SurfacePiece& piece : pieces) {
      SpectrumMass m{.at = piece.at, .mass = 0};
      m.at.spacing = spacing(m.at);
      m.mass = piece.area / (m.at.spacing * m.at.spacing);
      total += m.mass;
      all.push_back(m);
    }
    for (SpectrumMass& m : all) m.mass *= count_ / total;
    return all;
  }

 private:
  SpacingTree tree_;
  double count_;
  bool uniform_;
};

/// A rectangle of the plane, or its four quarters if it is too large, and so on.
void quarter(const Vec2& corner, const Vec2& size, const SpectrumSurface::Limit& limit,
             std::vector<SurfacePiece>& out) {
  const Vec2 middle = corner + size / 2;
  const SpectrumPoint at{.position = {middle.x(), middle.y(), 0}};
  const double area = size.x() * size.y();
  if (area <= limit(at)) {
    out.push_back({at, area});
    geom::require(static_cast<double>(out.size()) < most_copies, "spacings differ too much");
    return;
  }
  for (const double x : {corner.x(), middle.x()})
    for (const double y : {corner.y(), middle.y()}) quarter({x, y}, size / 2, limit, out);
}

/// A grid of rectangles that are nearly square, those divided further that are too large. If spacings are
/// uniform none of them is.
std::vector<SurfacePiece> pieces_of_rectangle(const Vec2& size, const Density& density, double per_sample) {
  const double count = density.uniform() ? per_sample * density.count() : per_sample;
  const double cell = std::sqrt(size.x() * size.y() / count);
  const int columns = std::max(1, static_cast<int>(std::ceil(size.x() / cell)));
  const int rows = std::max(1, static_cast<int>(std::ceil(size.y() / cell)));
  const Vec2 piece(size.x() / columns, size.y() / rows);
  std::vector<SurfacePiece> pieces;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      quarter(
          {i * piece.x(), j * piece.y()}, piece,
          [&](const SpectrumPoint& x) { return density.piece_area(x, per_sample) * (1 + 1e-9); }, pieces);
  return pieces;
}

/// The samples in one rectangle, without spacings.
std::vector<SpectrumPoint> placed(std::span<const geom::WeightedPoint2> samples, const PlaneRegion& region) {
  std::vector<SpectrumPoint> points;
  for (const geom::WeightedPoint2& s : samples) {
    Vec2 x = s.position;
    for (Eigen::Index k = 0; k < 2; ++k) {
      const bool inside = x[k] >= 0 && x[k] <= region.size[k];
      geom::require(inside || region.periodic, "a sample lies outside the rectangle (see --period)");
      if (!inside) x[k] -= std::floor(x[k] / region.size[k]) * region.size[k];
    }
    points.push_back({.position = {x.x(), x.y(), 0}});
  }
  return points;
}

double largest_spacing(const std::vector<SpectrumPoint>& samples) {
  double largest = 0;
  for (const SpectrumPoint& s : samples) largest = std::max(largest, s.spacing);
  return largest;
}

}  // namespace

SpectrumSet plane_set(std::span<const geom::WeightedPoint2> samples, const PlaneRegion& region,
                      SpacingRule rule, double radius) {
  geom::require(samples.size() >= 2, "a spectrum needs two samples at least");
  SpectrumSet set;
  set.samples = placed(samples, region);
  const double area = region.size.x() * region.size.y();
  const auto copies = [&](double margin) {
    return region.periodic ? copies_of_samples(set.samples, region.size, margin)
                           : std::vector<SpectrumPoint>();
  };
  if (rule == SpacingRule::weights) spacings_from_weights(set.samples, samples);
  if (rule == SpacingRule::local)
    spacings_from_density(set.samples, tree_with(set.samples, copies(region.size.maxCoeff())));
  fill_area(set.samples, area);
  const double margin = radius * largest_spacing(set.samples);
  set.copies = copies(margin);
  const bool uniform = rule == SpacingRule::uniform;
  if (uniform && region.periodic) return set;
  const Density density(set.samples, set.copies, uniform);
  set.viewpoints = density.masses(pieces_of_rectangle(region.size, density, viewpoint_density));
  set.background = density.masses(pieces_of_rectangle(region.size, density, background_density));
  if (region.periodic) {
    const auto more = copies_within(set.background, region.size, margin,
                                    [](SpectrumMass& b) -> Vec3& { return b.at.position; });
    set.background.insert(set.background.end(), more.begin(), more.end());
  }
  return set;
}

SpectrumSet surface_set(std::span<const geom::WeightedPoint3> samples, const SpectrumSurface& surface,
                        SpacingRule rule, double detail) {
  geom::require(samples.size() >= 2, "a spectrum needs two samples at least");
  SpectrumSet set;
  for (const geom::WeightedPoint3& s : samples) set.samples.push_back(surface.place(s.position));
  if (rule == SpacingRule::weights) spacings_from_weights(set.samples, samples);
  if (rule == SpacingRule::local) spacings_from_density(set.samples, SpacingTree(set.samples));
  fill_area(set.samples, surface.area());
  const Density density(set.samples, {}, rule == SpacingRule::uniform);
  const auto pieces = [&](double per_sample) {
    return density.masses(
        surface.pieces([&](const SpectrumPoint& x) { return density.piece_area(x, per_sample); }));
  };
  set.viewpoints = pieces(detail * viewpoint_density);
  set.background = pieces(detail * background_density);
  return set;
}

}  // namespace fpo
