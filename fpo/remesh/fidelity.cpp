#include "fpo/remesh/fidelity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fpo/interruption.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"

namespace fpo {

using geom::EmptyCircle;
using geom::Vec3;

namespace {

constexpr std::size_t iterations = 10;  // as many moves as they take, and some for small numbers
constexpr std::size_t least_moves = 2000;
constexpr std::size_t patience =
    8;  // a round begins with the farthest: if they stay, so does the largest distance
constexpr double least_gain = 0.5;  // of a triangle's penalty: else attempts nibble at it for ever

/// Distances between the surface and triangles of samples on it.
class Distances {
 public:
  explicit Distances(const SurfaceDomain& domain) : domain_(domain), tree_(domain.mesh()) {}

  /// The largest one of some points of the triangle, or 0 if the circle's facet shows that it is at most
  /// `enough`: mostly it does, and saves a search.
  double beyond(const EmptyCircle& circle, double enough) const { return farthest(circle, enough).distance; }

  /// The point of the surface below the point of the triangle that is farthest from it, those left out that
  /// the circle's facet shows to be no farther than `enough`.
  struct Farthest {
    double distance;
    SurfaceSample below;
  };
  Farthest farthest(const EmptyCircle& circle, double enough = -1) const {
    std::array<Vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = domain_.sample(circle.sites[i]).position;
    const std::array<Vec3, 4> middles{(x[0] + x[1]) / 2, (x[1] + x[2]) / 2, (x[2] + x[0]) / 2,
                                      (x[0] + x[1] + x[2]) / 3};
    Farthest result{0, {circle.center, circle.facet}};
    const std::array<Vec3, 3>& facet = tree_.triangle(circle.facet);
    for (const Vec3& middle : middles) {
      if (enough >= 0 && geom::closest_point(middle, facet).distance2 <= enough * enough) continue;
      const geom::AabbTree::Closest closest = tree_.closest(middle, circle.facet);
      if (closest.distance2 > result.distance * result.distance)
        result = {std::sqrt(closest.distance2), {geom::snapped(closest.point), closest.facet}};
    }
    return result;
  }

  double largest() const {
    double most = 0;
    for (std::size_t i = 0; i < domain_.num_samples(); ++i)
      for (const CircleId c : domain_.dual().circles_of(SiteId(i))) {
        const EmptyCircle& circle = domain_.dual().circle(c);
        if (circle.sites[0] == SiteId(i) && circle.sites[2].valid())
          most = std::max(most, beyond(circle, most));
      }
    return most;
  }

 private:
  const SurfaceDomain& domain_;
  geom::AabbTree tree_;
};

bool mend(const SurfaceDomain& domain, LocalResampling& resampling, const Distances& distances,
          CircleId triangle, const FidelityOptions& options) {
  const EmptyCircle circle = domain.dual().circle(triangle);
  const SurfaceSample below = distances.farthest(circle).below;
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
  const Distances distances(domain);
  FidelityResult result;
  result.largest_before = distances.largest();
  const double bound = options.share_of_largest * result.largest_before;
  if (!(bound > 0)) return result;
  Flaws far(domain, [&](const EmptyCircle& circle) {
    const double beyond = std::max(distances.beyond(circle, bound) / bound - 1, 0.0);
    return beyond * beyond;
  });
  Flaws bad(domain, bad_angles(domain, angles));
  LocalResampling resampling(domain, {&far, &bad}, options.enough_delta);
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
  result.largest_after = distances.largest();
  return result;
}

}  // namespace fpo
