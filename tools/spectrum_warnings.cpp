#include "tools/spectrum_warnings.h"

#include <algorithm>
#include <cstdio>

#include "fpo/spectrum/spacing_tree.h"
#include "fpo/surface/sizing.h"
#include "io/input_file.h"

namespace tools {
namespace {

/// The value that so large a share of them does not exceed.
double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

void warn_if_adaptive(const std::filesystem::path& input, std::span<const geom::WeightedPoint3> samples,
                      const fpo::SpectrumSurface& surface) {
  constexpr std::size_t least_samples = 300;  // of fewer the spacings say little
  constexpr double most_ratio = 1.6;          // of spacings; 1.4 for white noise, by 24 neighbours
  if (samples.size() < least_samples) return;
  std::vector<fpo::SpectrumPoint> points;
  for (const geom::WeightedPoint3& s : samples) points.push_back(surface.place(s.position));
  const fpo::SpacingTree tree(points);
  std::vector<double> distances;
  std::vector<fpo::SpacingTree::Neighbour> near;
  for (const fpo::SpectrumPoint& x : points) {
    tree.nearest(x, 24, near);
    distances.push_back(near.empty() ? 0 : std::sqrt(near.back().distance2));
  }
  const double ratio = quantile(distances, 0.95) / quantile(distances, 0.05);
  if (ratio > most_ratio)
    std::fprintf(
        stderr,
        "warning: %s: spacings differ by a factor of %.1f: the set is adaptive (its sizes are missing: "
        "--sizes, weights, or --spacing local)\n",
        io::display_name(input).c_str(), ratio);
}

void warn_if_elsewhere(const std::filesystem::path& input, std::span<const geom::WeightedPoint3> samples,
                       const fpo::SpectrumSurface& surface) {
  constexpr double most_share = 1.0 / 3;
  const double spacing = fpo::hexagonal_spacing(surface.area(), samples.size());
  std::vector<double> distances;
  for (const geom::WeightedPoint3& s : samples) distances.push_back(surface.distance(s.position));
  const double far = quantile(distances, 0.99);
  if (far > most_share * spacing)
    std::fprintf(stderr, "warning: %s: its samples lie up to %.1f spacings beside --surface: is it theirs?\n",
                 io::display_name(input).c_str(), far / spacing);
}

}  // namespace tools
