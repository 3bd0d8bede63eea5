#include "fpo/spectrum_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fpo/spacing_tree.h"
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

/// Between samples: the mean of the nearest ones, by inverse squared distance.
double interpolated_spacing(const SpectrumPoint& x, const SpacingTree& tree,
                            std::vector<SpacingTree::Neighbour>& near) {
  tree.nearest(x, neighbours_for_interpolation, near);
  double sum = 0, weights = 0;
  for (const SpacingTree::Neighbour& p : near) {
    const double spacing = tree.points()[p.index].spacing;
    const double weight = 1 / (p.distance2 + 1e-6 * spacing * spacing);
    sum += weight * spacing;
    weights += weight;
  }
  return sum / weights;
}

/// Gives each piece its spacing and the number of samples to expect there, n in all.
std::vector<SpectrumMass> background_of(const std::vector<SurfacePiece>& pieces, double n, bool uniform,
                                        const SpacingTree& tree) {
  std::vector<SpectrumMass> background;
  std::vector<SpacingTree::Neighbour> near;
  double total = 0;
  for (const SurfacePiece& piece : pieces) {
    SpectrumMass b{.at = piece.at, .mass = 0};
    b.at.spacing = uniform ? tree.points().front().spacing : interpolated_spacing(b.at, tree, near);
    if (!std::isfinite(b.at.spacing)) continue;  // faces away from every sample
    b.mass = piece.area / (b.at.spacing * b.at.spacing);
    total += b.mass;
    background.push_back(b);
  }
  for (SpectrumMass& b : background) b.mass *= n / total;
  return background;
}

/// Squares of a grid, or nearly.
std::vector<SurfacePiece> pieces_of_rectangle(const Vec2& size, double count) {
  const double cell = std::sqrt(size.x() * size.y() / count);
  const int columns = std::max(1, static_cast<int>(std::ceil(size.x() / cell)));
  const int rows = std::max(1, static_cast<int>(std::ceil(size.y() / cell)));
  const double width = size.x() / columns, height = size.y() / rows;
  std::vector<SurfacePiece> pieces;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      pieces.push_back({{.position = {(i + 0.5) * width, (j + 0.5) * height, 0}}, width * height});
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
  const auto n = static_cast<double>(samples.size());
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
  const SpacingTree near = tree_with(set.samples, set.copies);
  const auto pieces = [&](double density) {
    return background_of(pieces_of_rectangle(region.size, density * n), n, uniform, near);
  };
  set.viewpoints = pieces(viewpoint_density);
  set.background = pieces(background_density);
  if (region.periodic) {
    const auto more = copies_within(set.background, region.size, margin,
                                    [](SpectrumMass& b) -> Vec3& { return b.at.position; });
    set.background.insert(set.background.end(), more.begin(), more.end());
  }
  return set;
}

SpectrumSet surface_set(std::span<const geom::WeightedPoint3> samples, const SpectrumSurface& surface,
                        SpacingRule rule) {
  geom::require(samples.size() >= 2, "a spectrum needs two samples at least");
  SpectrumSet set;
  for (const geom::WeightedPoint3& s : samples) set.samples.push_back(surface.place(s.position));
  if (rule == SpacingRule::weights) spacings_from_weights(set.samples, samples);
  if (rule == SpacingRule::local) spacings_from_density(set.samples, SpacingTree(set.samples));
  fill_area(set.samples, surface.area());
  const auto n = static_cast<double>(samples.size());
  const SpacingTree near(set.samples);
  const auto pieces = [&](double density) {
    return background_of(surface.pieces(density * n), n, rule == SpacingRule::uniform, near);
  };
  set.viewpoints = pieces(viewpoint_density);
  set.background = pieces(background_density);
  return set;
}

}  // namespace fpo
