#include "fpo/angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "fpo/optimize.h"
#include "geom/indexed_heap.h"

namespace fpo {

using geom::EmptyCircle;
using geom::Vec3;

namespace {

/// A sample as it was, to go back to.
struct Backup {
  SiteId id;
  SurfaceSample place;
  double weight_share;
};

/// The angles of the triangle at a circle, in degrees, at its sites in their order.
std::array<double, 3> angles_of(const SurfaceDomain& domain, const EmptyCircle& circle) {
  std::array<double, 3> angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& at = domain.sample(circle.sites[i]).position;
    const Vec3 u = domain.sample(circle.sites[(i + 1) % 3]).position - at,
               v = domain.sample(circle.sites[(i + 2) % 3]).position - at;
    angles[i] = 180 / std::numbers::pi * std::atan2(u.cross(v).norm(), u.dot(v));
  }
  return angles;
}

/// The bad triangles of the RRT, followed through removals and insertions.
class BadTriangles {
 public:
  BadTriangles(SurfaceDomain& domain, const AngleOptions& options)
      : domain_(domain),
        options_(options),
        untried_(Order{&domain.diagram()}),
        delta_(measure(domain).delta) {
    for (std::size_t i = 0; i < domain.num_samples(); ++i) {
      const SiteId x(i);
      for (CircleId c = domain.diagram().first_circle(x); c.valid(); c = domain.diagram().next_circle(c, x))
        if (domain.diagram().circle(c).sites[0] == x) add(c);
    }
  }

  std::size_t number() const { return number_; }
  /// The sum of the squares of the degrees by which they miss the bounds.
  double badness() const { return badness_; }
  /// The smallest normalized spacing at the start.
  double delta() const { return delta_; }

  void remove(SiteId x) {
    domain_.remove(x);
    follow(domain_.last_change());
  }
  void insert(SiteId x, const SurfaceSample& place, double weight_share) {
    domain_.insert_at(x, place, weight_share);
    follow(domain_.last_change());
  }

  /// The worst that take_worst() has not given yet since try_all_again(); none if there is none.
  CircleId take_worst() {
    if (untried_.empty()) return CircleId();
    const CircleId c = untried_.top().slot;
    untried_.erase(c);
    tried_.insert(domain_.diagram().circle(c).sites);
    return c;
  }
  void try_all_again() {
    tried_.clear();
    for (std::size_t c = 0; c < badness_of_.size(); ++c)
      if (badness_of_[CircleId(c)] > 0 && !untried_.contains(CircleId(c)))
        untried_.push(CircleId(c), badness_of_[CircleId(c)]);
  }

 private:
  struct Order {
    const geom::RestrictedPower* diagram;
    bool operator()(CircleId a, CircleId b) const { return diagram->circle_before(a, b); }
  };

  void follow(const geom::RestrictedPower::Change& change) {
    for (const CircleId c : change.circles_erased) forget(c);
    for (const CircleId c : change.circles_created) add(c);
  }

  void add(CircleId c) {
    const EmptyCircle& circle = domain_.diagram().circle(c);
    if (!circle.sites[2].valid()) return;  // type A or B: no triangle
    const auto [least, most] = std::ranges::minmax(angles_of(domain_, circle));
    const double beyond = std::max(options_.smallest - least, 0.0) + std::max(most - options_.largest, 0.0);
    if (!(beyond > 0)) return;
    const double bad = beyond * beyond;
    if (c.index() >= badness_of_.size()) badness_of_.resize(c.index() + 1, 0.0);
    badness_of_[c] = bad;
    badness_ += bad;
    ++number_;
    if (!tried_.contains(circle.sites)) untried_.push(c, bad);
  }

  void forget(CircleId c) {
    if (c.index() >= badness_of_.size() || badness_of_[c] == 0) return;
    badness_ -= badness_of_[c];
    badness_of_[c] = 0;
    --number_;
    if (untried_.contains(c)) untried_.erase(c);
  }

  SurfaceDomain& domain_;
  const AngleOptions& options_;
  geom::IndexedHeap<CircleId, Order> untried_;
  std::set<std::array<SiteId, 3>> tried_;     ///< triangles: what is undone comes back as another circle
  geom::Table<CircleId, double> badness_of_;  ///< 0: good or no triangle
  double delta_;
  double badness_ = 0;
  std::size_t number_ = 0;
};

/// Algorithm 1 for one sample: to the farthest point nearby, if that is farther than where it is.
void resample(SurfaceDomain& domain, BadTriangles& bad, SiteId x, double weight_share) {
  if (domain.is_fixed(x)) return;
  const double d = domain.separation(x);
  const SurfaceSample home = domain.sample(x);
  bad.remove(x);
  const Circle c = domain.largest_empty(Scope::two_ring);
  if (c.radius2 > d) {
    const EmptyCircle& circle = domain.diagram().circle(c.id);
    bad.insert(x, {circle.center, circle.facet}, weight_share);
  } else {
    bad.insert(x, home, weight_share);
  }
}

void restore(BadTriangles& bad, const Backup& x) {
  bad.remove(x.id);
  bad.insert(x.id, x.place, x.weight_share);
}

constexpr int passes = 4;          // of resampling in an attempt
constexpr std::size_t crowd = 24;  // samples: twice those around a triangle of a manifold
constexpr double rounding = 1e-9;  // badness is a running sum

/// Lowers the weights of samples[1] and [2] and resamples all in turn, until the world is better and delta no
/// smaller than at the start: true. Else
/// puts everything back.
bool attempt(SurfaceDomain& domain, BadTriangles& bad, std::span<const SiteId> samples, double weight_share) {
  const double before = bad.badness();
  const auto wide = [&](SiteId x) {
    return !domain.sizing().is_uniform() || domain.normalized_spacing(x) >= bad.delta();
  };
  std::vector<Backup> backups;
  for (const SiteId x : samples) backups.push_back({x, domain.sample(x), domain.weight_share(x)});
  const auto lowered = [&](std::size_t i) {
    return backups[i].weight_share * (i == 1 || i == 2 ? weight_share : 1.0);
  };
  for (std::size_t i = 1; i < 3 && weight_share < 1; ++i) {
    if (domain.is_fixed(samples[i])) continue;
    bad.remove(samples[i]);
    bad.insert(samples[i], backups[i].place, lowered(i));
  }
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t i = 0; i < samples.size(); ++i) {
      resample(domain, bad, samples[i], lowered(i));
      if (bad.badness() < before - rounding && std::ranges::all_of(samples, wide)) return true;
    }
  for (const Backup& x : backups) restore(bad, x);
  return false;
}

/// Tries to better a triangle: by resampling alone, which often suffices, then the paper's way, with each
/// share of the weights; then so that the samples around follow, first those at the bad angle, then those at
/// the other corners.
bool mend(SurfaceDomain& domain, BadTriangles& bad, CircleId triangle, const AngleOptions& options) {
  const EmptyCircle circle = domain.diagram().circle(triangle);
  const std::array<double, 3> angles = angles_of(domain, circle);
  const auto worst = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
  std::vector<SiteId> samples;
  for (std::size_t i = 0; i < 3; ++i) samples.push_back(circle.sites[(worst + i) % 3]);
  const auto attempt_all = [&] {
    return attempt(domain, bad, samples, 1) || std::ranges::any_of(options.weight_shares, [&](double c) {
             return attempt(domain, bad, samples, c);
           });
  };
  if (attempt_all()) return true;
  std::vector<SiteId> link;
  for (std::size_t i = 0; i < 3; ++i) {
    domain.diagram().link(samples[i], link);
    for (const SiteId y : link)
      if (std::ranges::find(samples, y) == samples.end()) samples.push_back(y);
    if (samples.size() > crowd) return false;  // where everything touches everything, nothing can be mended
    if (attempt_all()) return true;
  }
  return false;
}

/// Gives each sample its full weight back unless that makes things worse. The number that keep a smaller one.
std::size_t restore_weights(SurfaceDomain& domain, BadTriangles& bad) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const Backup x{SiteId(i), domain.sample(SiteId(i)), domain.weight_share(SiteId(i))};
    if (x.weight_share == 1) continue;
    const double before = bad.badness();
    bad.remove(x.id);
    bad.insert(x.id, x.place, 1);
    if (bad.badness() <= before + rounding) continue;
    restore(bad, x);
    ++kept;
  }
  return kept;
}

}  // namespace

AngleResult optimize_angles(SurfaceDomain& domain, const AngleOptions& options) {
  BadTriangles bad(domain, options);
  AngleResult result;
  result.bad_before = bad.number();
  const auto interrupted = [&] {
    return options.interrupted && options.interrupted->load(std::memory_order_relaxed);
  };
  const std::size_t most = options.max_attempts + domain.num_samples() / 10;
  while (result.tried < most && !interrupted()) {
    const std::size_t mended_before = result.mended;
    bad.try_all_again();
    for (CircleId c; result.tried < most && !interrupted() && (c = bad.take_worst()).valid(); ++result.tried)
      result.mended += mend(domain, bad, c, options);
    if (result.mended == mended_before) break;
  }
  result.reweighted = restore_weights(domain, bad);
  result.bad_after = bad.number();
  return result;
}

}  // namespace fpo
