#include "fpo/remesh/sent_away.h"

#include <algorithm>
#include <vector>

#include "fpo/farthest_move.h"
#include "fpo/interruption.h"
#include "fpo/remesh/remembered_samples.h"

namespace fpo {
namespace {

constexpr std::size_t few_faults = 12;
constexpr int most_sent = 48;  // of samples that leave, one after the other

/// Those at fault and around them, but for fixed ones.
std::vector<SiteId> near_defects(SurfaceDomain& domain, const std::vector<Defect>& defects) {
  std::vector<SiteId> near, link;
  const auto add = [&](SiteId x) {
    if (x.valid() && !domain.is_fixed(x) && std::ranges::find(near, x) == near.end()) near.push_back(x);
  };
  for (const Defect& defect : defects) add(defect.at), add(defect.towards);
  for (const Defect& defect : defects) {
    domain.neighbours(defect.at, link);
    for (const SiteId x : link) add(x);
  }
  return near;
}

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
    for (const SiteId x : near_defects(domain, best.defects)) {
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

}  // namespace fpo
