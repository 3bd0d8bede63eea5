#include "fpo/remesh/sent_away.h"

#include <algorithm>
#include <array>
#include <vector>

#include "fpo/farthest_move.h"
#include "fpo/interruption.h"
#include "fpo/remesh/nearby_places.h"
#include "fpo/remesh/remembered_samples.h"
#include "fpo/remesh/sample_state.h"

namespace fpo {
namespace {

constexpr std::size_t few_faults = 12;
constexpr int most_sent = 48;                         // of samples that leave, one after the other
constexpr int most_nudged = 20;                       // of places tried in a row that do not help
constexpr std::array<double, 2> nudges = {0.2, 0.4};  // in wanted lengths
constexpr int directions = 6;

/// Those at fault and around them, but for fixed ones.
std::vector<SiteId> near_faults(SurfaceDomain& domain, const Dual& dual) {
  const std::vector<SiteId> at = samples_at_fault(dual);
  std::vector<SiteId> near, link;
  const auto add = [&](SiteId x) {
    if (!domain.is_fixed(x) && std::ranges::find(near, x) == near.end()) near.push_back(x);
  };
  for (const SiteId x : at) add(x);
  for (const SiteId x : at) {
    domain.neighbours(x, link);
    for (const SiteId y : link) add(y);
  }
  return near;
}

/// The first of some places of samples with which the dual has fewer faults than `best`, which it becomes.
class Nudging {
 public:
  Nudging(SurfaceDomain& domain, const std::function<Dual()>& next_dual, const std::atomic<bool>* interrupted)
      : domain_(domain), next_dual_(next_dual), interrupted_(interrupted), tree_(domain.mesh()) {}

  /// One step of each after the other, so that all have their turn.
  bool finds_better(std::span<const SiteId> near, Dual& best) {
    std::vector<SampleState> before;
    std::vector<std::vector<SurfaceSample>> places;
    for (const SiteId x : near) {
      before.push_back(state_of(domain_, x));
      places.push_back(nearby_places(domain_.mesh(), tree_, before.back().place,
                                     {domain_.sizing().at(before.back().place), nudges, directions}));
    }
    int tried = 0;
    for (std::size_t k = 0; k < nudges.size() * directions; ++k)
      for (std::size_t i = 0; i < near.size(); ++i) {
        if (k >= places[i].size()) continue;
        if (++tried > most_nudged || fpo::interrupted(interrupted_)) return false;
        put_back(domain_, near[i], {places[i][k], before[i].weight_share});
        Dual next = next_dual_();
        if (next.num_faults() < best.num_faults()) {
          best = std::move(next);
          return true;
        }
        put_back(domain_, near[i], before[i]);
      }
    return false;
  }

 private:
  SurfaceDomain& domain_;
  const std::function<Dual()>& next_dual_;
  const std::atomic<bool>* interrupted_;
  geom::AabbTree tree_;
};

}  // namespace

bool send_to_farthest(SurfaceDomain& domain, SiteId x) {
  std::vector<SiteId> around;
  domain.neighbours(x, around);
  if (!move_to_farthest(domain, x)) return false;
  for (const SiteId y : around)
    if (!domain.is_fixed(y)) domain.move(y, Scope::two_ring);
  return true;
}

std::size_t send_away(SurfaceDomain& domain, const std::function<Dual()>& next_dual,
                      const std::atomic<bool>* interrupted, Dual& best) {
  std::size_t sent = 0;
  int trials = 0;
  for (bool goes_on = true; goes_on && !best.type.ok() && best.num_faults() <= few_faults;) {
    goes_on = false;
    const RememberedSamples before(domain);
    for (const SiteId x : near_faults(domain, best)) {
      if (++trials > most_sent || fpo::interrupted(interrupted)) return sent;
      if (!send_to_farthest(domain, x)) continue;
      Dual next = next_dual();
      if (next.num_faults() < best.num_faults()) {
        best = std::move(next);
        ++sent;
        goes_on = true;
        break;
      }
      before.put_back(domain);
    }
  }
  return sent;
}

std::size_t nudge_aside(SurfaceDomain& domain, const std::function<Dual()>& next_dual,
                        const std::atomic<bool>* interrupted, Dual& best) {
  if (best.type.ok() || best.num_faults() > few_faults) return 0;
  Nudging nudging(domain, next_dual, interrupted);
  std::size_t moved = 0;
  while (!best.type.ok() && nudging.finds_better(near_faults(domain, best), best)) ++moved;
  return moved;
}

}  // namespace fpo
