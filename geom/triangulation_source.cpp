#include "geom/triangulation_source.h"

#include <limits>

namespace geom {

void TriangulationSource::insert(SiteId id, const WeightedPoint3& point, SiteId hint) {
  const Regular3::Change change = triangulation_.insert(id, point, hint);
  last_hidden_.assign(change.hidden.begin(), change.hidden.end());
  std::erase(last_hidden_, id);
  if (id.index() >= place_.size()) place_.resize(id.index() + 1, -1);
  place_[id] = static_cast<std::int32_t>(present_.size());
  present_.push_back(id);
}

void TriangulationSource::remove(SiteId id) {
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

void TriangulationSource::rivals(SiteId p, std::vector<SiteId>& out) const {
  triangulation_.link(p, out);
  out.insert(out.end(), last_hidden_.begin(), last_hidden_.end());
}

void TriangulationSource::heirs(const Vacancy&, std::vector<SiteId>& out) const {
  out.insert(out.end(), last_heirs_.begin(), last_heirs_.end());
}

NeighbourSource::Nearest TriangulationSource::nearest_of(const Vec3& x, SiteId without,
                                                         const std::vector<SiteId>& sites) const {
  Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
  for (const SiteId s : sites) {
    const double radius2 = power(x, triangulation_.point(s));
    const bool better = radius2 < best.radius2 || (radius2 == best.radius2 && s < best.site);
    if (s != without && (better || !best.site.valid())) best = {s, radius2};
  }
  return best;
}

NeighbourSource::Nearest TriangulationSource::nearest(const Vec3& x, SiteId without, SiteId hint) const {
  if (!hint.valid() || triangulation_.is_hidden(hint)) return nearest_of(x, without, present_);
  Nearest at{hint, power(x, triangulation_.point(hint))};
  std::vector<SiteId> link;
  for (;;) {
    link.clear();
    triangulation_.link(at.site, link);
    const Nearest next = nearest_of(x, SiteId(), link);
    if (!next.site.valid() || !(next.radius2 < at.radius2)) break;
    at = next;
  }
  if (at.site != without) return at;
  return link.empty() ? nearest_of(x, without, present_) : nearest_of(x, without, link);
}

}  // namespace geom
