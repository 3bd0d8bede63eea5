#include "fpo/remesh/angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "fpo/interruption.h"
#include "fpo/measure/triangle_angles.h"

namespace fpo {

using geom::EmptyCircle;
using geom::Vec3;

namespace {

/// The angles of the triangle at a circle, in degrees, at its sites in their order.
std::array<double, 3> angles_at(const SurfaceDomain& domain, const EmptyCircle& circle) {
  const auto at = [&](std::size_t i) { return domain.sample(circle.sites[i]).position; };
  return angles_of({at(0), at(1), at(2)});
}

/// Tries to better a triangle: by resampling alone, which often suffices, then the paper's way, with each
/// share of the weights; then so that the samples around follow, first those at the bad angle, then those at
/// the other corners.
bool mend(const SurfaceDomain& domain, LocalResampling& resampling, CircleId triangle,
          const AngleOptions& options) {
  const EmptyCircle circle = domain.dual().circle(triangle);
  const std::array<double, 3> angles = angles_at(domain, circle);
  const auto worst = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
  const std::array<SiteId, 3> corners{circle.sites[worst], circle.sites[(worst + 1) % 3],
                                      circle.sites[(worst + 2) % 3]};
  if (in_growing_sets(domain, corners, [&](std::span<const SiteId> samples) {
        if (interrupted(options.interrupted)) return false;
        return resampling.attempt(samples, 1) || std::ranges::any_of(options.weight_shares, [&](double c) {
                 return resampling.attempt(samples, c);
               });
      }))
    return true;
  for (std::size_t i = 0; i < 3 && options.slides; ++i)
    if (resampling.attempt_to_slide(std::array{corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]}))
      return true;
  return false;
}

}  // namespace

FlawMeasure bad_angles(const SurfaceDomain& domain, const AngleOptions& options) {
  const double smallest = options.smallest, largest = options.largest;
  return [&domain, smallest, largest](const EmptyCircle& circle, double) {
    const auto [least, most] = std::ranges::minmax(angles_at(domain, circle));
    const double beyond = std::max(smallest - least, 0.0) + std::max(most - largest, 0.0);
    return beyond * beyond;
  };
}

AngleResult optimize_angles(SurfaceDomain& domain, const AngleOptions& options) {
  Flaws bad(domain, bad_angles(domain, options));
  LocalResampling resampling(domain, {&bad}, options.enough_delta);
  resampling.let_slide(options.slides);
  AngleResult result;
  result.bad_before = bad.number();
  const std::size_t most_moves = options.max_moves + 20 * domain.num_samples();
  const std::size_t most_futile = 16 + domain.num_samples() / 100;  // attempts in a row
  std::size_t futile = 0;
  const auto enough = [&] {
    return resampling.moves() > most_moves || futile > most_futile || interrupted(options.interrupted);
  };
  while (!enough()) {
    const std::size_t mended_before = result.mended;
    bad.try_all_again();
    for (CircleId c; !enough() && (c = bad.take_worst()).valid(); ++result.tried) {
      const std::array<SiteId, 3> corners = domain.dual().circle(c).sites;  // c may come back as another
      const bool mended = mend(domain, resampling, c, options) || resampling.nudge(corners);
      result.mended += mended;
      futile = mended ? 0 : futile + 1;
    }
    if (result.mended == mended_before) break;
  }
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    result.reweighted += !resampling.restore_weight(SiteId(i));
  result.bad_after = bad.number();
  return result;
}

}  // namespace fpo
