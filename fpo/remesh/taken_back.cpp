#include "fpo/remesh/taken_back.h"

#include <algorithm>
#include <vector>

#include "fpo/interruption.h"
#include "fpo/rings.h"

namespace fpo {
namespace {

constexpr int most_rounds = 10, most_rings = 5;

std::vector<SiteId> around_faults(SurfaceDomain& domain, const Dual& dual, int rings) {
  std::vector<SiteId> near = samples_at_fault(dual), link;
  std::size_t from = 0;
  for (int ring = 0; ring < rings; ++ring)
    for (const std::size_t end = near.size(); from < end; ++from) {
      domain.neighbours(near[from], link);
      add_missing(near, link);
    }
  return near;
}

/// Those that are in the cells of these samples now, or were there. How many.
std::size_t put_back_near(SurfaceDomain& domain, const RememberedSamples& before,
                          const std::vector<SiteId>& near) {
  const auto is_near = [&](SiteId x) { return std::ranges::find(near, x) != near.end(); };
  std::vector<RememberedSamples::Changed> changed = before.changed_in(domain);
  std::erase_if(changed, [&](const RememberedSamples::Changed& c) {
    const SurfaceSample& place = c.was.place;
    const double level = domain.dual().level_at(place.facet, place.position);
    return !is_near(c.sample) && !is_near(domain.dual().nearest({place.position, level}, SiteId()).site);
  });
  for (const auto& [x, was] : changed) put_back(domain, x, was);
  return changed.size();
}

}  // namespace

bool take_back(SurfaceDomain& domain, const RememberedSamples& before, const std::function<Dual()>& next_dual,
               const std::atomic<bool>* interrupted, Dual& dual) {
  int rings = 1;
  for (int round = 0; round < most_rounds && !is_right(dual) && !fpo::interrupted(interrupted); ++round) {
    while (put_back_near(domain, before, around_faults(domain, dual, rings)) == 0)
      if (++rings > most_rings) return false;
    const std::size_t faults = dual.num_faults();
    dual = next_dual();
    if (dual.num_faults() >= faults) ++rings;
  }
  return is_right(dual);
}

}  // namespace fpo
