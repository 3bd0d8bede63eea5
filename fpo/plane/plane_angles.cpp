#include "fpo/plane/plane_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "fpo/interruption.h"
#include "fpo/optimize.h"
#include "fpo/penalties.h"
#include "fpo/rings.h"

namespace fpo {

using geom::Regular2;
using geom::SimplexId;
using geom::Vec2;

namespace {

constexpr int passes = 16;         // of resampling in an attempt
constexpr int most_rings = 3;      // around the corners of a bad triangle that may be resampled
constexpr double rounding = 1e-9;  // penalty is a running sum
constexpr double margin = 0.05;    // degrees more than wanted, so that what creeps up to the bound passes it

/// The smallest angle of a triangle, in degrees, and the corner that has it.
struct SmallestAngle {
  double degrees = 180;
  std::size_t corner = 0;
};

SmallestAngle smallest_angle(const Regular2& t, const Regular2::Triangle& corner) {
  SmallestAngle least;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = t.difference(corner[k], corner[(k + 1) % 3]),
               b = t.difference(corner[k], corner[(k + 2) % 3]);
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180 / std::numbers::pi;
    if (angle < least.degrees) least = {angle, k};
  }
  return least;
}

/// The bad triangles, followed through removals and insertions.
class BadTriangles final : public Follower<Regular2::Change> {
 public:
  BadTriangles(PlaneDomain& domain, double smallest) : domain_(domain), smallest_(smallest) {
    domain.followers().add(*this);
    for (std::size_t t = 0; t < domain.triangulation().simplex_capacity(); ++t)
      if (domain.triangulation().is_live(SimplexId(t))) add(SimplexId(t));
  }

  std::size_t number() const { return penalties_.number(); }
  /// The sum of the squares of the degrees that they miss.
  double penalty() const { return penalties_.sum(); }
  bool contains(SimplexId t, const Regular2::Triangle& corners) const {
    return penalties_.of(t) > 0 && domain_.triangulation().corners(t) == corners;
  }

  /// With their corners, the worst first.
  std::vector<std::pair<SimplexId, Regular2::Triangle>> worst_first() const {
    std::vector<std::pair<SimplexId, Regular2::Triangle>> all;
    for (SimplexId t(0); t.index() < penalties_.num_ids(); ++t.value)
      if (penalties_.of(t) > 0) all.emplace_back(t, domain_.triangulation().corners(t));
    std::ranges::sort(all, [&](const auto& a, const auto& b) {
      const double of_a = penalties_.of(a.first), of_b = penalties_.of(b.first);
      if (of_a != of_b) return of_a > of_b;
      return domain_.triangulation().simplex_before(a.first, b.first);
    });
    return all;
  }

  ~BadTriangles() override { domain_.followers().remove(*this); }

  /// Less than at the start if negative.
  std::ptrdiff_t more_hidden() const { return more_hidden_; }

  /// Moves x somewhere, which `move` does.
  template <class Move>
  void move(SiteId x, Move&& move) {
    more_hidden_ -= domain_.triangulation().is_hidden(x);
    move();
  }

 private:
  void follow(const Regular2::Change& change) override {
    more_hidden_ += std::ssize(change.hidden) - std::ssize(change.exposed);
    for (const SimplexId t : change.destroyed) penalties_.forget(t);
    for (const SimplexId t : change.created) add(t);
  }
  void add(SimplexId t) {
    const double angle = smallest_angle(domain_.triangulation(), domain_.triangulation().corners(t)).degrees;
    if (angle >= smallest_) return;
    const double missing = smallest_ + margin - angle;
    penalties_.add(t, missing * missing);
  }

  PlaneDomain& domain_;
  double smallest_;
  Penalties<SimplexId> penalties_;
  std::ptrdiff_t more_hidden_ = 0;
};

/// A sample as it was, to go back to.
struct Backup {
  SiteId id;
  Vec2 position;
  double weight_share;
};

void put(PlaneDomain& domain, BadTriangles& bad, const Backup& x) {
  bad.move(x.id, [&] {
    domain.remove(x.id);
    domain.insert_at(x.id, x.position, x.weight_share);
  });
}

/// The spacing of the sample nearest to another among these and their neighbours.
double least_spacing(PlaneDomain& domain, std::span<const SiteId> samples) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<SiteId> link;
  for (const SiteId x : samples) {
    least = std::min(least, domain.normalized_spacing(x));
    domain.neighbours(x, link);
    for (const SiteId y : link) least = std::min(least, domain.normalized_spacing(y));
  }
  return least;
}

/// What attempts keep to.
struct Limits {
  const std::vector<double>& weight_shares;
  double spacing;  ///< none of the samples around comes nearer to another, unless it has been before
};

/// One way to better a triangle: the weights of samples[1] and [2] are lowered, then all are resampled in
/// turn, `steps` moves altogether.
struct Attempt {
  double weight_share = 1;
  std::size_t steps = 0;
  double penalty = std::numeric_limits<double>::infinity();  ///< that it leads to
};

std::vector<Backup> backups_of(const PlaneDomain& domain, std::span<const SiteId> samples) {
  std::vector<Backup> backups;
  for (const SiteId x : samples)
    backups.push_back({x, domain.triangulation().point(x).position, domain.weight_share(x)});
  return backups;
}

/// Carries an attempt out, and calls after_step(number of moves).
template <class AfterStep>
void carry_out(PlaneDomain& domain, BadTriangles& bad, std::span<const SiteId> samples, const Attempt& plan,
               AfterStep&& after_step) {
  for (std::size_t i = 1; i < 3 && plan.weight_share < 1; ++i) {
    const Backup now = backups_of(domain, samples.subspan(i, 1))[0];
    put(domain, bad, {now.id, now.position, plan.weight_share * now.weight_share});
  }
  for (std::size_t step = 0; step < plan.steps; ++step) {
    const SiteId x = samples[step % samples.size()];
    bad.move(x, [&] { domain.move(x, Scope::two_ring); });
    after_step(step + 1);
  }
}

/// The best that resampling these samples can do; each way is tried and undone.
Attempt best_attempt(PlaneDomain& domain, BadTriangles& bad, std::span<const SiteId> samples,
                     const Limits& limits) {
  const double spacing = std::min(limits.spacing, least_spacing(domain, samples));
  const std::ptrdiff_t hidden = bad.more_hidden();
  const std::vector<Backup> backups = backups_of(domain, samples);
  Attempt best;
  best.penalty = bad.penalty() - rounding;
  for (const double share : limits.weight_shares) {
    const Attempt plan{share, passes * samples.size()};
    carry_out(domain, bad, samples, plan, [&](std::size_t step) {
      if (bad.penalty() < best.penalty && bad.more_hidden() <= hidden &&
          least_spacing(domain, samples) >= spacing)
        best = {share, step, bad.penalty()};
    });
    for (const Backup& x : backups) put(domain, bad, x);
  }
  return best;
}

/// Tries to better a triangle: the paper's way, then so that the samples around follow.
bool mend(PlaneDomain& domain, BadTriangles& bad, const Regular2::Triangle& corners, const Limits& limits) {
  const std::size_t worst = smallest_angle(domain.triangulation(), corners).corner;
  std::vector<SiteId> samples, link;
  for (std::size_t i = 0; i < 3; ++i) samples.push_back(corners[(worst + i) % 3]);
  for (int ring = 0;; ++ring) {
    const Attempt best = best_attempt(domain, bad, samples, limits);
    if (best.steps > 0) {
      carry_out(domain, bad, samples, best, [](std::size_t) {});
      return true;
    }
    if (ring == most_rings) return false;
    for (std::size_t i = 0, inner = samples.size(); i < inner; ++i) {
      domain.neighbours(samples[i], link);
      add_missing(samples, link);
    }
  }
}

/// Gives each sample its full weight back unless that makes things worse.
void restore_weights(PlaneDomain& domain, BadTriangles& bad) {
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const Backup now{SiteId(i), domain.triangulation().point(SiteId(i)).position,
                     domain.weight_share(SiteId(i))};
    if (now.weight_share == 1) continue;
    const double before = bad.penalty();
    const std::ptrdiff_t hidden = bad.more_hidden();
    put(domain, bad, {now.id, now.position, 1});
    if (bad.penalty() > before + rounding || bad.more_hidden() > hidden) put(domain, bad, now);
  }
}

}  // namespace

PlaneAngleResult optimize_angles(PlaneDomain& domain, const PlaneAngleOptions& options) {
  BadTriangles bad(domain, options.smallest);
  PlaneAngleResult result;
  result.bad_before = bad.number();
  const auto one_round = [&](const Limits& limits) {
    const std::size_t mended_before = result.mended;
    for (const auto& [t, corners] : bad.worst_first()) {
      if (interrupted(options.interrupted)) return false;
      if (!bad.contains(t, corners)) continue;
      ++result.tried;
      result.mended += mend(domain, bad, corners, limits);
    }
    return result.mended > mended_before;
  };
  const std::vector<double> spacings =
      domain.is_uniform() ? std::vector{measure(domain).delta} : options.least_spacings;
  for (const double spacing : spacings) {
    int round = 0;
    while (round < options.max_rounds && one_round({options.weight_shares, spacing})) ++round;
  }
  restore_weights(domain, bad);
  result.bad_after = bad.number();
  return result;
}

}  // namespace fpo
