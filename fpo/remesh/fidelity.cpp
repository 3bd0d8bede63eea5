#include "fpo/remesh/fidelity.h"

#include <algorithm>
#include <cmath>

#include "fpo/interruption.h"
#include "fpo/remesh/triangle_distances.h"

namespace fpo {

using geom::EmptyCircle;

namespace {

constexpr std::size_t iterations = 10;  // as many moves as they take, and some for small numbers
constexpr std::size_t least_moves = 2000;
constexpr std::size_t patience =
    8;  // a round begins with the farthest: if they stay, so does the largest distance
constexpr double least_gain = 0.5;  // of a triangle's penalty: else attempts nibble at it for ever

double largest_distance(const SurfaceDomain& domain, const TriangleDistances& distances) {
  double most = 0;
  for_triangles(domain.dual(), [&](const EmptyCircle& circle) {
    most = std::max(most, distances.farthest(circle, most).distance);
  });
  return most;
}

bool mend(const SurfaceDomain& domain, LocalResampling& resampling, const TriangleDistances& distances,
          CircleId triangle, const FidelityOptions& options) {
  const EmptyCircle circle = domain.dual().circle(triangle);
  const SurfaceSample below = distances.farthest(circle).at;
  return in_growing_sets(domain, circle.sites, [&](std::span<const SiteId> samples) {
    if (interrupted(options.interrupted)) return false;
    if (resampling.attempt(samples, 1)) return true;
    std::vector<SiteId> turned(samples.begin(), samples.end());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (resampling.attempt_at(turned, below)) return true;
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    }
    return false;
  });
}

}  // namespace

FidelityResult improve_fidelity(SurfaceDomain& domain, const AngleOptions& angles,
                                const FidelityOptions& options) {
  if (interrupted(options.interrupted)) return {};
  const TriangleDistances distances(domain);
  FidelityResult result;
  result.largest_before = largest_distance(domain, distances);
  const double bound = options.share_of_largest * result.largest_before;
  if (!(bound > 0)) return result;
  Flaws far(domain, [&](const EmptyCircle& circle, double) {
    const double beyond = std::max(distances.farthest(circle, bound).distance / bound - 1, 0.0);
    return beyond * beyond;
  });
  Flaws bad(domain, bad_angles(domain, angles));
  LocalResampling resampling(domain, {&far, &bad}, options.enough_delta);
  resampling.let_slide(angles.slides);  // none does here, but edges of curves are kept
  if (options.keep_spacing) resampling.keep_spacing();
  const std::size_t most_moves =
      std::min(options.most_moves, least_moves + iterations * domain.num_samples());
  const auto enough = [&] { return resampling.moves() > most_moves || interrupted(options.interrupted); };
  for (bool progress = true; progress && !enough();) {
    progress = false;
    far.try_all_again();
    std::size_t futile = 0;  // in a row
    for (CircleId c; futile < patience && !enough() && (c = far.take_worst()).valid(); ++result.tried) {
      resampling.require_gain(least_gain * far.penalty(c));
      const bool mended = mend(domain, resampling, distances, c, options);
      result.mended += mended;
      futile = mended ? 0 : futile + 1;
      progress |= mended;
    }
  }
  result.largest_after = largest_distance(domain, distances);
  return result;
}

}  // namespace fpo
