#include "geom/sites/triangulation_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {

void TriangulationOracle::insert(SiteId id, const WeightedPoint3& point, SiteId hint) {
  const Regular3::Change change = triangulation_.insert(id, point, hint);
  last_hidden_.assign(change.hidden.begin(), change.hidden.end());
  std::erase(last_hidden_, id);
  if (id.index() >= place_.size()) place_.resize(id.index() + 1, -1);
  place_[id] = static_cast<std::int32_t>(present_.size());
  present_.push_back(id);
}

void TriangulationOracle::remove(SiteId id) {
  last_heirs_.clear();
  triangulation_.link(id, last_heirs_);
  const Regular3::Change change = triangulation_.remove(id);
  last_heirs_.insert(last_heirs_.end(), change.exposed.begin(), change.exposed.end());
  const std::int32_t place = place_[id];
  present_[static_cast<std::size_t>(place)] = present_.back();
  place_[present_.back()] = place;
  present_.pop_back();
  place_[id] = -1;
}

void TriangulationOracle::rivals(SiteId p, std::vector<SiteId>& out) const {
  triangulation_.link(p, out);
  out.insert(out.end(), last_hidden_.begin(), last_hidden_.end());
}

void TriangulationOracle::heirs(const Vacancy&, std::vector<SiteId>& out) const {
  out.insert(out.end(), last_heirs_.begin(), last_heirs_.end());
}

NeighbourOracle::Nearest TriangulationOracle::nearest_of_all(const Vec3& x, SiteId without) const {
  Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
  for (const SiteId s : present_) offer(x, s, without, best);
  return best;
}

void TriangulationOracle::offer(const Vec3& x, SiteId s, SiteId without, Nearest& best) const {
  const double radius2 = power(x, triangulation_.point(s));
  const bool better = radius2 < best.radius2 || (radius2 == best.radius2 && s < best.site);
  if (s != without && (better || !best.site.valid())) best = {s, radius2};
}

// In a regular triangulation a site that is not the nearest to x has a nearer neighbour, so the sites of
// power at most any bound are connected. Where rounding hides which one is nearest, all sites within its
// reach are visited, and the answer is that of trying them all. What is nearest if `without` is left out owns
// the place of x once that is gone: a neighbour of it, or a site that it hides.
NeighbourOracle::Nearest TriangulationOracle::nearest(const Location3& location, SiteId without,
                                                      SiteId hint) const {
  const Vec3& x = location.position;
  if (!hint.valid() || triangulation_.is_hidden(hint)) return nearest_of_all(x, without);
  constexpr double unsure = 0x1p-48;  // 32 roundings
  Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
  std::vector<SiteId> visited{hint}, around;
  for (std::size_t i = 0; i < visited.size(); ++i) {
    triangulation_.link_and_hidden(visited[i], around);
    around.push_back(visited[i]);
    for (const SiteId s : around) offer(x, s, without, best);
    if (!best.site.valid()) continue;
    const double weight = triangulation_.point(best.site).weight;
    const double limit = best.radius2 + unsure * (std::abs(best.radius2) + 2 * std::abs(weight));
    for (const SiteId s : around)
      if (power(x, triangulation_.point(s)) <= limit && !triangulation_.is_hidden(s) &&
          std::ranges::find(visited, s) == visited.end())
        visited.push_back(s);
  }
  return best;
}

}  // namespace geom
