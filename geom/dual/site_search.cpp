#include "geom/dual/site_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double cell_of_grid = 2.4;  // in square roots of the area of a cell

}  // namespace

void SiteSearch::enter(SiteId p) {
  tree_.insert(p, sites_[p]);
  if (grid_.is_in_use()) grid_.insert(p, sites_[p].position);
  ++size_;
}

void SiteSearch::leave(SiteId p) {
  tree_.remove(p);
  if (grid_.is_in_use()) grid_.remove(p, sites_[p].position);
  --size_;
}

void SiteSearch::follow(SiteId p, const Vec3& from) {
  tree_.move(p, sites_[p]);
  if (grid_.is_in_use()) grid_.move(p, from, sites_[p].position);
}

double SiteSearch::choose(double area, double extent) {
  const auto [least, most] = std::ranges::minmax(sites_, {}, &WeightedPoint3::weight);
  const double spacing = std::sqrt(area / static_cast<double>(size_));
  if (least.weight != most.weight || !(spacing > 0) || extent > 1e5 * spacing) return 0;
  grid_ = SiteGrid(cell_of_grid * spacing, size_);
  for (SiteId p(0); p.index() < sites_.size(); p = SiteId(p.value + 1))
    if (tree_.contains(p)) grid_.insert(p, sites_[p].position);
  return spacing;
}

void SiteSearch::near(const Vacancy& vacancy, std::vector<SiteId>& out) const {
  const double far2 = vacancy.max_radius2 + heaviest_;
  const double distance = vacancy.radius + (far2 > 0 ? std::sqrt(far2) : 0);
  if (grid_.is_in_use() && grid_.is_short(distance))
    grid_.near(vacancy.center, distance, out);
  else
    tree_.heirs(vacancy, out);
}

bool SiteSearch::find_near(const Vec3& x, double distance, std::vector<SiteId>& out) const {
  if (!grid_.is_in_use() || !grid_.is_short(distance)) return false;
  grid_.near(x, distance, out);
  return true;
}

/// A site beside one that is in bounds the distance.
NeighbourOracle::Nearest SiteSearch::nearest(const Location3& x, SiteId without) const {
  double bound = std::numeric_limits<double>::infinity();
  if (grid_.is_in_use() && without.valid())
    for (const CircleId c : circles_.of_site(without)) {
      const EmptyCircle& circle = circles_[c];
      const SiteId s = circle.sites[circle.after(circle.index_of(without))];
      if (s.valid()) bound = std::min(bound, power(x, sites_[s]));
    }
  const double distance = std::sqrt(std::max(0.0, bound + heaviest_)) * (1 + 1e-9);
  if (!(distance < std::numeric_limits<double>::infinity()) || !grid_.is_short(distance))
    return tree_.nearest(x, without);
  std::vector<SiteId>& found = found_;
  found.clear();
  grid_.near(x.position, distance, found);
  NeighbourOracle::Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
  for (const SiteId s : found) {
    if (s == without) continue;
    const double radius2 = power(x, sites_[s]);
    if (radius2 < best.radius2 || (radius2 == best.radius2 && s < best.site)) best = {s, radius2};
  }
  return best;
}

}  // namespace geom
