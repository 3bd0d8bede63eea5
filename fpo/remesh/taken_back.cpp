#include "fpo/remesh/taken_back.h"

#include <set>
#include <vector>

#include "fpo/interruption.h"

namespace fpo {
namespace {

constexpr int most_rounds = 10, most_rings = 5;

/// Those that are in the cells of these samples now, or were there. How many.
std::size_t put_back_near(SurfaceDomain& domain, const RememberedSamples& before,
                          const std::set<SiteId>& near) {
  std::vector<RememberedSamples::Changed> changed = before.changed_in(domain);
  std::erase_if(changed, [&](const RememberedSamples::Changed& c) {
    const SurfaceSample& place = c.was.place;
    const double level = domain.dual().level_at(place.facet, place.position);
    return !near.contains(c.sample) &&
           !near.contains(domain.dual().nearest({place.position, level}, SiteId()).site);
  });
  for (const auto& [x, was] : changed) put_back(domain, x, was);
  return changed.size();
}

}  // namespace

bool take_back(SurfaceDomain& domain, const RememberedSamples& before, const std::function<Dual()>& next_dual,
               const std::atomic<bool>* interrupted, Dual& dual) {
  int rings = 1;
  for (int round = 0; round < most_rounds && !is_right(dual) && !fpo::interrupted(interrupted); ++round) {
    const std::vector<SiteId> at_fault = samples_at_fault(dual);
    while (rings <= most_rings && put_back_near(domain, before, neighbourhood(domain, at_fault, rings)) == 0)
      ++rings;
    if (rings > most_rings) return false;
    const std::size_t faults = dual.num_faults();
    dual = next_dual();
    if (dual.num_faults() >= faults) ++rings;
  }
  return is_right(dual);
}

}  // namespace fpo
