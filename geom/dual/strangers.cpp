#include "geom/dual/strangers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double more = 1 + 1e-9;  // for the rounding of distances
constexpr double ampler = 2.5;     // in radii of the vacancy: what is found will do for the new cell, too

}  // namespace

void Strangers::find_heirs(const Vacancy& vacancy, double range) {
  if (state_.paper) {
    found_.clear();
    state_.paper->heirs(vacancy, found_);
    return;
  }
  const double distance = std::min(vacancy.radius + state_.distance_at(vacancy.max_radius2), range);
  if (knows(vacancy.center, distance)) return;
  forget();
  const double ample = std::max(distance, ampler * vacancy.radius);
  if (state_.find_near(vacancy.center, ample, found_)) {
    center_ = vacancy.center;
    radius_ = ample;
  } else {
    state_.near(vacancy, found_);
  }
}

void Strangers::find_rivals(SiteId p, const Vec3& center, double radius) {
  if (!state_.paper)
    return find_heirs({p, center, radius, radius * radius * more - state_.sites[p].weight}, 1e300);
  found_.clear();
  state_.paper->rivals(p, found_);
}

// At a location z that s loses, |z - s| is at most the distance of s at its reach, and |z - p| that of p at the same
// power.
double Strangers::power_of_rivals(SiteId p, SiteId neighbour) {
  const WeightedPoint3& point = state_.sites[p];
  const double least = state_.distance_at(state_.reach[neighbour]);
  double most_reach = least * least - point.weight;
  for (const SiteId s : found_) {
    const double reach = state_.reach[s];
    if (!(reach > most_reach) || s == p) continue;
    const double far = state_.distance_at(reach, s) + state_.distance_at(reach, p);
    if ((state_.sites[s].position - point.position).squaredNorm() <= far * far * more) most_reach = reach;
  }
  const double unseen = radius_ - (point.position - center_).norm() * more;
  if (radius_ >= 0 && 2 * state_.distance_at(state_.largest_reach()) <= unseen) return most_reach;
  return state_.tree.largest_rival_reach(point, most_reach);
}

void Strangers::keep_near(const Frame& frame, SiteId p, std::span<const SiteId> rim, const Ball& ball,
                          int first) {
  kept_.clear();
  const WeightedPoint3& origin = frame.origin();
  for (const SiteId s : found_) {
    if (s == p || std::ranges::find(rim, s) != rim.end()) continue;
    const Vec3 d = Frame::offset(state_.sites[s], origin);
    const double c = Frame::constant(state_.sites[s], origin);
    if (!frame.is_behind(d, c, ball.center, ball.radius, first)) kept_.push_back({s, d, c});
  }
}

// Powers are off by a few units of their terms; where the point is off by at most `off`, the lead moves by 2 off times
// the distance of the two sites, which is at most the sum of their distances from the point.
bool Strangers::are_beyond(const Vec3& point, const WeightedPoint3& owner, double off) const {
  const double here2 = (point - owner.position).squaredNorm();
  return std::ranges::all_of(kept_, [&](const Stranger& stranger) {
    const WeightedPoint3& site = state_.sites[stranger.site];
    const double there2 = (point - site.position).squaredNorm(), both2 = here2 + there2;
    const double terms = both2 + std::abs(site.weight) + std::abs(owner.weight);
    const double bound =
        0x1p-47 * terms + 3 * off * std::sqrt(both2);  // the sum is at most sqrt(2) times the root
    return (there2 - site.weight) - (here2 - owner.weight) > bound;
  });
}

}  // namespace geom
