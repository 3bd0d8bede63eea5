#include "fpo/remesh/closeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "fpo/interruption.h"
#include "fpo/optimize.h"
#include "fpo/remesh/flaws.h"
#include "fpo/remesh/nearby_places.h"
#include "fpo/remesh/spreading.h"
#include "fpo/remesh/surface_above.h"
#include "geom/mesh/scaling.h"
#include "geom/parallel.h"

namespace fpo {

using geom::EmptyCircle;

namespace {

constexpr std::size_t most_futile = 8;  // in a row: if the farthest stay, so does the largest distance
constexpr double least_share = 0.5;     // of a triangle's penalty: else attempts nibble at it for ever
constexpr double least_share_of_nudge = 0.2;
constexpr std::size_t few = 12;                                   // samples to nudge
constexpr std::array<double, 4> circles = {0.05, 0.1, 0.2, 0.3};  // in units of h
constexpr int directions_about = 12;
constexpr std::array<double, 4> ways = {0.25, 0.5, 0.75, 1};  // to the far point
constexpr double rounding = 1e-9;
constexpr std::size_t most_trials = 24;  // of the places that promise most
constexpr double least_promise = 0.95;   // of the distance
constexpr double least_fall = 0.97;      // of the largest distance, to go on
constexpr double most_share = 0.93;      // else less is asked for
constexpr double passing = 0.05;         // of delta, until others have made room

class Distances {
 public:
  /// Keeps references.
  Distances(const SurfaceDomain& domain, const TriangleDistances& triangles)
      : domain_(domain), triangles_(triangles), above_(domain.mesh()) {}

  const geom::AabbTree& tree() const { return triangles_.tree(); }
  std::size_t looks() const { return above_.looks(); }

  /// Both ways; those left out that are seen at once to be no farther than `enough`, and it may be any beyond
  /// `most`.
  FarPoint farthest(const EmptyCircle& circle, double enough = 0,
                    double most = std::numeric_limits<double>::infinity()) {
    std::array<SurfaceSample, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = domain_.sample(circle.sites[i]);
    const auto beside = [&](std::vector<geom::DistanceFromTriangle>& triangles) {
      add_beside(circle, triangles);
    };
    const FarPoint below = triangles_.farthest(circle, enough);
    if (below.distance > most) return below;
    const FarPoint above = above_.farthest(corners, {std::max(enough, below.distance), most}, beside,
                                           Prism::margin_beside(least_cosine(circle)));
    return above.distance > below.distance ? above : below;
  }

  /// Of a point from the triangles around x if that is put at a place, as far as these stay the same.
  double distance_after(SiteId x, const SurfaceSample& place, const geom::Vec3& point) const {
    double least2 = std::numeric_limits<double>::infinity();
    for (const CircleId c : domain_.dual().circles_of(x)) {
      const std::array<SiteId, 3>& t = domain_.dual().circle(c).sites;
      if (!t[2].valid()) continue;
      const auto at = [&](std::size_t i) {
        return t[i] == x ? place.position : domain_.sample(t[i]).position;
      };
      const geom::DistanceFromTriangle triangle({at(0), at(1), at(2)});
      least2 = std::min(least2, triangle.distance2(point));
    }
    return std::sqrt(least2);
  }

 private:
  /// Seen from where its sites run counterclockwise, of length twice the triangle's area.
  geom::Vec3 normal_of(const EmptyCircle& circle) const {
    const auto at = [&](std::size_t i) -> geom::Vec3 { return domain_.sample(circle.sites[i]).position; };
    const geom::Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
    return circle.clockwise ? -normal : normal;
  }

  /// The least cosine of the angle to a triangle beside it; -1 near a border, beyond which the surface may go
  /// on: there edges of the diagram have no other end.
  double least_cosine(const EmptyCircle& circle) const {
    const geom::Vec3 normal = normal_of(circle).normalized();
    double least = 1;
    for (const SiteId s : circle.sites)
      for (const CircleId c : domain_.dual().circles_of(s)) {
        const EmptyCircle& other = domain_.dual().circle(c);
        if (!other.is_triangle() || std::ranges::find(other.beyond, CircleId()) != other.beyond.end())
          return -1;
        least = std::min(least, normal.dot(normal_of(other).normalized()));
      }
    return least;
  }

  /// Those with two corners in common come first.
  void add_beside(const EmptyCircle& circle, std::vector<geom::DistanceFromTriangle>& triangles) const {
    std::size_t across = 0;
    for (const SiteId s : circle.sites)
      for (const CircleId c : domain_.dual().circles_of(s)) {
        const std::array<SiteId, 3>& t = domain_.dual().circle(c).sites;
        if (!t[2].valid() || t == circle.sites) continue;
        const auto at = [&](std::size_t i) { return domain_.sample(t[i]).position; };
        triangles.emplace_back(std::array{at(0), at(1), at(2)});
        const auto common = std::ranges::count_if(
            t, [&](SiteId x) { return std::ranges::find(circle.sites, x) != circle.sites.end(); });
        if (common == 2) std::swap(triangles[across++], triangles.back());
      }
  }

  const SurfaceDomain& domain_;
  const TriangleDistances& triangles_;
  SurfaceAbove above_;
};

double penalty_of(double distance, double bound) {
  const double beyond = std::max(distance / bound - 1, 0.0);
  return beyond * beyond;
}

/// The distance whose penalty is that, for sure not less.
double distance_of(double penalty, double bound) { return bound * (1 + std::sqrt(penalty)) * (1 + rounding); }

double beyond(Distances& distances, const EmptyCircle& circle, double bound, double enough) {
  return penalty_of(distances.farthest(circle, bound, distance_of(enough, bound)).distance, bound);
}

/// The triangles that are farther than a bound.
struct FarTriangles {
  double bound = 0;
  std::vector<std::pair<CircleId, double>> distances;  ///< by ids

  double largest() const {
    double most = 0;
    for (const auto& [triangle, far] : distances) most = std::max(most, far);
    return most;
  }
  /// Those of them. Requires a bound that is no smaller.
  FarTriangles beyond(double larger_bound) const {
    FarTriangles result{larger_bound, distances};
    std::erase_if(result.distances, [&](const auto& far) { return !(far.second > larger_bound); });
    return result;
  }
};

/// Distances of all triangles, found by some threads: each has its own workspace.
class AllDistances {
 public:
  AllDistances(const SurfaceDomain& domain, int threads)
      : domain_(domain), triangles_(domain), threads_(threads) {
    workspaces_.push_back(std::make_unique<Distances>(domain, triangles_));
  }

  /// For who asks about one after the other.
  Distances& one() { return *workspaces_.front(); }
  std::size_t looks() const {
    std::size_t sum = 0;
    for (const auto& workspace : workspaces_) sum += workspace->looks();
    return sum;
  }

  FarTriangles farther(double bound) { return farther(triangles_of(domain_.dual()), bound, 0); }

  /// Those that are farther than a share of the largest distance. The largest so far spares others most of
  /// the look: first that of some triangles, then of each range. Ranges do not depend on the number of
  /// threads.
  FarTriangles farthest(double share) {
    const std::vector<CircleId> triangles = triangles_of(domain_.dual());
    double some = 0;
    for (std::size_t i = 0; i < triangles.size(); i += looked_at_first)
      some = std::max(some, one().farthest(domain_.dual().circle(triangles[i]), some).distance);
    const FarTriangles found = farther(triangles, share * some, share);
    return found.beyond(share * found.largest());
  }

 private:
  static constexpr std::size_t grain = 1024, looked_at_first = 32;

  /// Than a bound that grows, in each range, with the largest so far, to that share of it.
  FarTriangles farther(const std::vector<CircleId>& triangles, double bound, double share) {
    std::vector<double> distances(triangles.size(), 0), bounds((triangles.size() + grain - 1) / grain, bound);
    in_ranges(triangles.size(), [&](Distances& of, std::size_t i) {
      double& least = bounds[i / grain];
      const double far = of.farthest(domain_.dual().circle(triangles[i]), least).distance;
      if (far > least) distances[i] = far;
      least = std::max(least, share * far);
    });
    FarTriangles result{bound, {}};
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (distances[i] > 0) result.distances.emplace_back(triangles[i], distances[i]);
    std::ranges::sort(result.distances);
    return result;
  }

  template <class Visit>
  void in_ranges(std::size_t count, const Visit& visit) {
    std::mutex access;
    std::vector<Distances*> idle;
    for (const auto& workspace : workspaces_) idle.push_back(workspace.get());
    const auto take = [&]() -> Distances& {
      const std::lock_guard lock(access);
      if (idle.empty())
        idle.push_back(workspaces_.emplace_back(std::make_unique<Distances>(domain_, triangles_)).get());
      Distances* const distances = idle.back();
      idle.pop_back();
      return *distances;
    };
    geom::parallel_ranges(count, grain, threads_, [&](std::size_t first, std::size_t last) {
      Distances& distances = take();
      for (std::size_t i = first; i < last; ++i) visit(distances, i);
      const std::lock_guard lock(access);
      idle.push_back(&distances);
    });
  }

  const SurfaceDomain& domain_;
  TriangleDistances triangles_;
  int threads_;
  std::vector<std::unique_ptr<Distances>> workspaces_;
};

/// Places on the way to a far point, and around the sample.
std::vector<SurfaceSample> places_towards(const SurfaceDomain& domain, const geom::AabbTree& tree,
                                          const SurfaceSample& x, const SurfaceSample& target) {
  std::vector<SurfaceSample> places =
      nearby_places(domain.mesh(), tree, x, {domain.sizing().at(x), circles, directions_about});
  for (const double way : ways) {
    const auto closest = tree.closest(x.position + way * (target.position - x.position), target.facet);
    places.push_back({geom::snapped(closest.point), closest.facet});
  }
  return places;
}

std::vector<double> penalties_of(std::span<const CircleId> triangles, const FarTriangles& far) {
  std::vector<double> result;
  result.reserve(triangles.size());
  for (const CircleId c : triangles) {
    const auto found = std::ranges::lower_bound(far.distances, c, {}, &std::pair<CircleId, double>::first);
    const bool is_far = found != far.distances.end() && found->first == c;
    result.push_back(is_far ? penalty_of(found->second, far.bound) : 0);
  }
  return result;
}

/// One far triangle after the other.
class CloserMender {
 public:
  /// `far`: as things are.
  CloserMender(SurfaceDomain& domain, AllDistances& all, const AngleOptions& angles, const FarTriangles& far,
               const ClosenessOptions& options)
      : domain_(domain),
        distances_(all.one()),
        options_(options),
        bound_(far.bound),
        delta_(std::min(options.enough_delta, measure(domain).delta)),
        far_(
            domain,
            [this](const EmptyCircle& circle, double enough) {
              return beyond(distances_, circle, bound_, enough);
            },
            Flaws::Sight::star,
            [&far](std::span<const CircleId> triangles) { return penalties_of(triangles, far); }),
        bad_(domain, bad_angles(domain, angles)),
        journal_(domain),
        resampling_(domain, {&far_, &bad_}, options.enough_delta - passing),
        spreading_(domain, {&far_, &bad_}, distances_.tree(), {delta_, options.enough_delta - passing}) {
    resampling_.keep(&journal_);
    spreading_.keep(&journal_);
  }

  Flaws& far() { return far_; }
  /// As things are now.
  FarTriangles far_triangles() {
    FarTriangles result{bound_, {}};
    for (const CircleId c : far_.all())
      result.distances.emplace_back(c, bound_ * (1 + std::sqrt(far_.penalty(c))));
    return result;
  }
  std::size_t moves() const { return resampling_.moves() + spreading_.moves(); }
  bool is_far_in_many_places() {
    const auto triangles = 2 * static_cast<double>(domain_.num_samples());  // of a closed surface, about
    return static_cast<double>(far_.number()) > options_.most_far * triangles;
  }

  /// Undoes what leaves samples too close to each other.
  bool mend(CircleId triangle) {
    journal_.clear();
    if (!move_some(triangle)) return false;
    if (!domain_.sizing().is_even() || (spreading_.spread() && are_wide_enough(journal_.noted())))
      return true;
    journal_.undo();
    return false;
  }

 private:
  /// Others may be near without an edge between: on another sheet.
  bool are_wide_enough(const std::vector<SiteId>& samples) {
    return std::ranges::all_of(
        samples, [&](SiteId x) { return domain_.normalized_spacing(x) >= delta_ * (1 - rounding); });
  }

  bool move_some(CircleId triangle) {
    const EmptyCircle circle = domain_.dual().circle(triangle);
    const FarPoint farthest = distances_.farthest(circle);
    const double before = far_.penalty(), penalty = far_.penalty(triangle);
    const double enough = before - least_share_of_nudge * penalty;
    const auto cost = [&](double limit) {
      if (far_.is_more_than(std::min(enough, limit))) return limit;
      const double far = far_.penalty();
      return spreading_.is_more_than(limit - far) ? limit : far + spreading_.penalty();
    };
    resampling_.require_gain(least_share * penalty);
    return in_growing_sets(domain_, circle.sites, [&](std::span<const SiteId> samples) {
      if (interrupted(options_.interrupted)) return false;
      if (samples.size() <= few && resampling_.nudge(trials(samples, farthest), cost, before)) return true;
      return resampling_.attempt(samples, 1) || put_at(farthest.at, samples);
    });
  }

  /// Those that would bring the far point nearer, and edges that are too short as a consequence.
  std::vector<Trial> trials(std::span<const SiteId> samples, const FarPoint& far) const {
    struct Estimate {
      double cost;
      Trial trial;
    };
    std::vector<Estimate> estimates;
    for (const SiteId x : samples) {
      if (domain_.is_fixed(x)) continue;
      const SurfaceSample home = domain_.sample(x);
      const double lack = spreading_.lack(x, home);
      for (const SurfaceSample& place : places_towards(domain_, distances_.tree(), home, far.at)) {
        const double after = distances_.distance_after(x, place, far.at.position);
        if (!(after < least_promise * far.distance)) continue;
        estimates.push_back({penalty_of(after, bound_) + spreading_.lack(x, place) - lack, {x, place}});
      }
    }
    std::ranges::stable_sort(estimates, {}, &Estimate::cost);
    std::vector<Trial> best;
    for (std::size_t i = 0; i < std::min(most_trials, estimates.size()); ++i)
      best.push_back(estimates[i].trial);
    std::ranges::stable_sort(best, {}, &Trial::sample);
    return best;
  }

  bool put_at(const SurfaceSample& place, std::span<const SiteId> samples) {
    std::vector<SiteId> turned(samples.begin(), samples.end());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (resampling_.attempt_at(turned, place)) return true;
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    }
    return false;
  }

  SurfaceDomain& domain_;
  Distances& distances_;
  const ClosenessOptions& options_;
  double bound_, delta_;
  Flaws far_, bad_;
  SampleJournal journal_;
  LocalResampling resampling_;
  Spreading spreading_;
};

/// The farthest first, until some in a row have stayed.
void mend_far(CloserMender& mender, const std::function<bool()>& enough, ClosenessResult& result) {
  std::size_t futile = 0;  // in a row
  for (CircleId c; futile < most_futile && !enough() && (c = mender.far().take_worst()).valid();
       ++result.tried) {
    const bool mended = mender.mend(c);
    result.mended += mended;
    futile = mended ? 0 : futile + 1;
  }
}

/// Round after round, until that brings nothing more. Where triangles that are so far are too many, or the
/// farthest stay, a round asks for less.
void mend_in_rounds(SurfaceDomain& domain, const AngleOptions& angles, const ClosenessOptions& options,
                    ClosenessResult& result) {
  AllDistances distances(domain, options.threads);
  double share = options.share_of_largest;
  FarTriangles far = distances.farthest(share);
  result.largest_before = result.largest_after = far.largest();
  std::size_t moves = 0;
  for (int round = 1; share < most_share && !far.distances.empty(); ++round) {
    CloserMender mender(domain, distances, angles, far, options);
    const auto enough = [&] {
      return moves + mender.moves() > options.most_moves || distances.looks() > options.most_looks ||
             interrupted(options.interrupted);
    };
    if (!mender.is_far_in_many_places()) mend_far(mender, enough, result);
    FarTriangles left = mender.far_triangles();
    if (left.distances.empty()) left = distances.farthest(share);
    const double before = std::exchange(result.largest_after, left.largest());
    if (enough() || round >= options.rounds) return;
    moves += mender.moves();
    if (!(result.largest_after < least_fall * before)) share = (1 + share) / 2;
    const double bound = share * result.largest_after;
    far = bound < left.bound ? distances.farther(bound) : left.beyond(bound);
  }
}

}  // namespace

ClosenessResult come_closer(SurfaceDomain& domain, const AngleOptions& angles,
                            const ClosenessOptions& options) {
  ClosenessResult result;
  if (interrupted(options.interrupted)) return result;
  const RememberedSamples before(domain, options.older);
  mend_in_rounds(domain, angles, options, result);
  if (result.mended > 0 && !(result.largest_after < least_fall * result.largest_before)) {
    before.put_back(domain);
    result.largest_after = result.largest_before;
    result.mended = 0;
  }
  return result;
}

}  // namespace fpo
