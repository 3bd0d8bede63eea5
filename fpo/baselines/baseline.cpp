#include "fpo/baselines/baseline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/sites/site_tree.h"

namespace fpo {

IterationReport measure(const BaselineTask& task, std::span<const SurfaceSample> samples) {
  geom::SiteTree tree;
  for (std::size_t i = 0; i < samples.size(); ++i) tree.insert(SiteId(i), {samples[i].position, 0});
  const std::size_t first = samples.size() > task.fixed.size() ? task.fixed.size() : 0;
  IterationReport report;
  report.delta = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = first; i < samples.size(); ++i) {
    const double distance2 = tree.nearest(samples[i].position, SiteId(i)).radius2;
    const double spacing = std::sqrt(distance2) / task.sizing.at(samples[i]);
    report.delta = std::min(report.delta, spacing);
    sum += spacing;
  }
  report.mean_delta = sum / static_cast<double>(std::max<std::size_t>(samples.size() - first, 1));
  return report;
}

}  // namespace fpo
