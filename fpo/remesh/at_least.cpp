#include "fpo/remesh/at_least.h"

#include <algorithm>
#include <cmath>

#include "fpo/surface/initial_samples.h"

namespace fpo {

AtLeastResult remesh_at_least(const geom::TriMesh& input, const RemeshOptions& options, double most_factor) {
  constexpr double growth = 1.5, close = 1.1;
  RemeshOptions attempt = options;
  AtLeastResult result{remesh(input, attempt), 1, 0};
  const auto interrupted = [&] { return options.optimize.interrupted && *options.optimize.interrupted; };
  const auto with = [&](double count) {
    attempt.num_samples = static_cast<std::size_t>(std::ceil(count));
    ++result.runs;
    return remesh(input, attempt);
  };
  const double most =
      std::min(most_factor * static_cast<double>(options.num_samples), static_cast<double>(max_samples));
  double enough = static_cast<double>(options.num_samples);
  while (!result.remesh.type.ok() && !interrupted() && enough < most) {
    result.not_enough = attempt.num_samples;
    enough = std::min(growth * enough, most);
    result.remesh = with(enough);
  }
  if (!result.remesh.type.ok()) return result;
  while (result.not_enough > 0 && enough > close * static_cast<double>(result.not_enough) && !interrupted()) {
    const double middle = (enough + static_cast<double>(result.not_enough)) / 2;
    RemeshResult fewer = with(middle);
    if (!fewer.type.ok()) {
      result.not_enough = attempt.num_samples;
      continue;
    }
    enough = middle;
    result.remesh = std::move(fewer);
  }
  return result;
}

}  // namespace fpo
