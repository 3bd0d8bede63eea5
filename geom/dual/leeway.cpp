#include "geom/dual/leeway.h"

#include <algorithm>

#include "geom/prefetch.h"

namespace geom {
namespace {

const Vec3 nowhere(1e300, 0, 0);

}  // namespace

void Leeways::begin(double spacing) {
  if (sites_.size() > most_sites) return;
  spacing_ = spacing;
  weight_ = sites_[SiteId(0)].weight;
  of_site_.resize(sites_.size());
  for (const WeightedPoint3& site : sites_) anchors_.push_back(site.position);
}

const Leeway* Leeways::of(SiteId p) const {
  if (!is_in_use() || !of_site_[p].stands) return nullptr;
  const Leeway& known = of_site_[p];
  const double limit2 = known.delta * known.delta;
  const double x = known.origin[0], y = known.origin[1], z = known.origin[2];
  for (const auto& [site, offset] : known.all()) {
    const Vec3& at = sites_[site].position;
    const double dx = at[0] - x - static_cast<double>(offset[0]),
                 dy = at[1] - y - static_cast<double>(offset[1]),
                 dz = at[2] - z - static_cast<double>(offset[2]);
    if (!(dx * dx + dy * dy + dz * dz <= limit2)) return nullptr;
  }
  return &known;
}

const Leeway* Leeways::of(SiteId p, std::span<const SiteId> rim) const {
  if (!is_in_use() || !std::ranges::equal(of_site_[p].rim(), rim, {}, &Leeway::Watched::site)) return nullptr;
  return of(p);
}

void Leeways::expect(SiteId p) const {
  if (!is_in_use()) return;
  const auto* const begin = reinterpret_cast<const char*>(&of_site_[p]);
  constexpr std::size_t line = 64;
  for (std::size_t i = 0; i < sizeof(Leeway); i += line) prefetch(begin + i);
}

void Leeways::set(SiteId p) {
  Leeway& now = of_site_[p];
  now.stands = true;
  longest_ = std::max(longest_, now.watch + now.own_delta);
}

void Leeways::set_guesses(SiteId p, std::span<const Leeway::Guess> guesses) {
  Leeway& known = of_site_[p];
  known.num_guesses = 0;
  if (guesses.size() > known.guesses.size()) return;
  known.num_guesses = static_cast<std::uint8_t>(guesses.size());
  std::ranges::copy(guesses, known.guesses.begin());
}

void Leeways::leave(SiteId p) {
  if (!is_in_use()) return;
  of_site_[p].stands = false;
  anchors_[p] = nowhere;
}

void Leeways::arrive(SiteId p, double way) {
  if (!is_in_use()) return;
  if (p.index() >= of_site_.size()) {
    of_site_.resize(p.index() + 1);
    anchors_.resize(p.index() + 1, nowhere);
  }
  const Vec3& x = sites_[p].position;
  Leeway& own = of_site_[p];
  own.way = static_cast<float>(way);
  own.stands = own.stands && own.allows(x);
  if ((x - anchors_[p]).squaredNorm() <= step() * step() * (1 - 1e-9)) return;
  anchors_[p] = x;
  own.failures = 0;
  if (longest_ == 0) return;
  found_.clear();
  if (!search_.find_near(x, longest_, found_)) return end();
  for (const SiteId s : found_) {
    Leeway& other = of_site_[s];
    if (s == p || !other.stands || (x - other.origin).squaredNorm() > other.watch * other.watch * (1 + 1e-9))
      continue;
    other.stands = std::ranges::find(other.all(), p, &Leeway::Watched::site) != other.all().end();
  }
}

}  // namespace geom
