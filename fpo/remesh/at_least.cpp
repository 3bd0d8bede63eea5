#include "fpo/remesh/at_least.h"

#include <algorithm>
#include <cmath>

#include "fpo/surface/initial_samples.h"
#include "geom/check.h"

namespace fpo {

namespace {

constexpr std::size_t surely_some_triangle = 64;  // samples

/// With so few a refusal may mean just that: then a result without a mesh, of another type.
RemeshResult remesh_or_none(const geom::TriMesh& input, const RemeshOptions& options) try {
  return remesh(input, options);
} catch (const geom::InputError&) {
  if (options.num_samples >= surely_some_triangle) throw;
  RemeshResult none;
  none.type.bare_samples = options.num_samples;
  return none;
}

}  // namespace

AtLeastResult remesh_at_least(const geom::TriMesh& input, const RemeshOptions& options, double most_factor) {
  constexpr double growth = 1.5, close = 1.1;
  RemeshOptions attempt = options;
  AtLeastResult result{remesh_or_none(input, attempt), 1, 0};
  const auto interrupted = [&] { return options.optimize.interrupted && *options.optimize.interrupted; };
  const auto with = [&](double count) {
    attempt.num_samples = static_cast<std::size_t>(std::ceil(count));
    ++result.runs;
    return remesh_or_none(input, attempt);
  };
  const double most =
      std::min(most_factor * static_cast<double>(options.num_samples), static_cast<double>(max_samples));
  double enough = static_cast<double>(options.num_samples);
  while (!result.remesh.type.ok() && !interrupted() && enough < most) {
    result.not_enough = attempt.num_samples;
    enough = std::min(growth * enough, most);
    result.remesh = with(enough);
  }
  if (result.remesh.mesh.num_facets() == 0) result.remesh = remesh(input, attempt);  // says why
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
