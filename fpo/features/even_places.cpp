#include "fpo/features/even_places.h"

#include <algorithm>

#include "fpo/features/curve_domain.h"
#include "fpo/optimize.h"
#include "geom/rng.h"

namespace fpo {

using geom::SiteId;

namespace {

constexpr double fully_spaced = 0.98;  // even spacing is near then
constexpr int curve_iterations = 200;

}  // namespace

std::vector<double> even_places(double length, bool loop, std::size_t count, std::uint64_t seed) {
  std::vector<double> positions;
  geom::Rng rng(seed);
  for (std::size_t i = 0; i < count; ++i) positions.push_back(length * rng.uniform());
  if (count == 0 || !(length > 0)) return positions;
  CurveDomain domain(length, loop, positions);
  OptimizeOptions options;
  options.max_iterations = curve_iterations;
  options.target_delta = fully_spaced;
  options.seed = seed;
  optimize(domain, options);
  for (std::size_t i = 0; i < count; ++i) positions[i] = domain.position(SiteId(i));
  // Even spacing, where this ends: in closed form, so that stretches side by side have samples side by side.
  const double gap = length / static_cast<double>(count + (loop ? 0 : 1));
  const double first = loop ? *std::ranges::min_element(positions) : gap;
  for (std::size_t i = 0; i < count; ++i) positions[i] = first + gap * static_cast<double>(i);
  for (double& t : positions)
    if (t >= length) t -= length;
  std::ranges::sort(positions);
  return positions;
}

}  // namespace fpo
