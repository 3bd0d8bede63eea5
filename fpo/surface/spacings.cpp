#include "fpo/surface/spacings.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "geom/sites/nearest_distances.h"

namespace fpo {

IterationReport measure_positions(std::span<const SurfaceSample> samples, const Sizing& sizing,
                                  std::size_t num_fixed, int threads) {
  std::vector<geom::Vec3> positions;
  positions.reserve(samples.size());
  for (const SurfaceSample& x : samples) positions.push_back(x.position);
  const std::size_t first = num_fixed < samples.size() ? num_fixed : 0;
  const std::vector<double> distances = geom::nearest_distances(positions, first, threads);
  IterationReport report;
  report.delta = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double spacing = distances[i] / sizing.at(samples[first + i]);
    report.delta = std::min(report.delta, spacing);
    sum += spacing;
  }
  report.mean_delta = sum / static_cast<double>(std::max<std::size_t>(distances.size(), 1));
  return report;
}

}  // namespace fpo
