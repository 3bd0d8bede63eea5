#include "fpo/remesh/protect.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace fpo {

using geom::SiteId;
using geom::Vec3;

namespace {

constexpr int rounds = 10;
constexpr double most_share = 8;  // of the usual weight: larger disks would swallow all around them

using Edge = std::pair<SiteId, SiteId>;

/// Those of the chains that the RRT lacks.
std::vector<Edge> missing_edges(const SurfaceDomain& domain, const FeatureSamples& features) {
  std::vector<Edge> missing;
  std::vector<SiteId> link;
  for (const std::vector<SiteId>& chain : features.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      domain.dual().link(chain[i], link);
      if (std::ranges::find(link, chain[i + 1]) == link.end()) missing.emplace_back(chain[i], chain[i + 1]);
    }
  return missing;
}

/// So that its disk reaches the middle of an edge of this length. False if it does already or never may.
bool raise_weight(SurfaceDomain& domain, SiteId x, double length2) {
  const double share = 1 + length2 / 4 / domain.full_weight(x);
  if (!(share > domain.weight_share(x)) || share > most_share) return false;
  const SurfaceSample place = domain.sample(x);
  domain.remove(x);
  domain.insert_at(x, place, share);
  return true;
}

bool move_away_from(SurfaceDomain& domain, const geom::Location3& middle) {
  const SiteId x = domain.dual().nearest(middle, SiteId()).site;
  if (domain.is_fixed(x)) return false;
  domain.remove(x);
  const Circle c = domain.largest_empty(Scope::global);
  if (!c.id.valid()) return domain.put_back(x), false;
  domain.insert_at(x, c);
  return true;
}

}  // namespace

Protection protect_chains(SurfaceDomain& domain, const FeatureSamples& features) {
  Protection result;
  std::set<SiteId> weighted;
  for (int round = 0; round < rounds; ++round) {
    bool changed = false;
    for (const auto& [a, b] : missing_edges(domain, features)) {
      const Vec3 from = domain.sample(a).position, to = domain.sample(b).position;
      bool raised = false;
      for (const SiteId x : {a, b})
        if (raise_weight(domain, x, (to - from).squaredNorm())) {
          weighted.insert(x);
          raised = true;
        }
      const Vec3 middle = (from + to) / 2;
      const double level = (domain.dual().site(a).level + domain.dual().site(b).level) / 2;
      const bool moved = !raised && move_away_from(domain, {middle, level});
      result.moved += moved;
      changed |= raised || moved;
    }
    if (!changed) break;
  }
  result.weighted = weighted.size();
  return result;
}

}  // namespace fpo
