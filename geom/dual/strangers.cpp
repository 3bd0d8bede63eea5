#include "geom/dual/strangers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double beyond = 1 + 1e-9;  // for the rounding of distances
constexpr double ampler = 2.5;       // in radii of the vacancy: what is found will do for the new cell, too

}  // namespace

void Strangers::find_heirs(const Vacancy& vacancy, double range) {
  within_ = infinity;
  if (state_.paper) {
    found_.clear();
    state_.paper->heirs(vacancy, found_);
    return;
  }
  const double distance = std::min(vacancy.radius + state_.distance_at(vacancy.max_radius2), range);
  around_ = vacancy.center;
  within_ = distance * beyond;
  if (knows(vacancy.center, distance)) return;
  forget();
  const double ample = std::max(distance, ampler * vacancy.radius);
  if (state_.search.find_near(vacancy.center, ample, found_)) {
    center_ = vacancy.center;
    radius_ = ample;
  } else {
    state_.search.near(vacancy, found_);
  }
}

void Strangers::find_rivals(SiteId p, const Vec3& center, double radius) {
  if (!state_.paper)
    return find_heirs({p, center, radius, radius * radius * beyond - state_.sites[p].weight}, 1e300);
  within_ = infinity;
  found_.clear();
  state_.paper->rivals(p, found_);
}

// At a location z that s loses, |z - s| is at most the distance of s at its reach, and |z - p| that of p at
// the same power. The two together are at least |p - s|: who is not known is far, and so one of them is.
void Strangers::find_rivals_beyond(double power, SiteId p, std::vector<SiteId>& out) const {
  const WeightedPoint3& point = state_.sites[p];
  for (const SiteId s : found_) {
    if (!(state_.reach[s] > power) || s == p) continue;
    const double far = state_.distance_at(state_.reach[s], s) + state_.distance_at(state_.reach[s], p);
    const double rise = state_.sites[s].level - point.level;
    if ((state_.sites[s].position - point.position).squaredNorm() + rise * rise <= far * far * beyond)
      out.push_back(s);
  }
  const double half = 0.5 * (radius_ - (point.position - center_).norm()) / beyond;
  if (half > 0) power = std::max(power, half * half / beyond - state_.search.heaviest());
  const std::size_t known = out.size();
  state_.search.tree().rivals_beyond(power, point, out);
  const auto is_known = [&](SiteId s) { return s == p || std::ranges::find(found_, s) != found_.end(); };
  out.erase(std::remove_if(out.begin() + static_cast<std::ptrdiff_t>(known), out.end(), is_known), out.end());
}

void Strangers::keep_near(const Frame& frame, SiteId p, std::span<const SiteId> rim, const Ball& ball,
                          int first) {
  kept_.clear();
  mark_.resize(state_.sites.size(), 0);
  ++calls_;
  for (const SiteId r : rim) mark_[r] = calls_;
  mark_[p] = calls_;
  const WeightedPoint3& origin = frame.origin();
  const double within2 = within_ * within_ * beyond;
  for (const SiteId s : found_) {
    if (mark_[s] == calls_ || !((state_.sites[s].position - around_).squaredNorm() <= within2)) continue;
    const WeightedPoint3& site = state_.sites[s];
    const Frame::Seen seen = Frame::seen(ball.is_level ? seen_from(origin.level, site) : site, origin);
    if (!frame.is_behind(seen, ball.center, ball.radius, first) &&
        !frame.is_behind_two(seen, ball.center, ball.radius))
      kept_.push_back({seen, s});
  }
}

bool Strangers::are_beyond(const SurfacePoint& point, const WeightedPoint3& owner) const {
  return std::ranges::all_of(
      kept_, [&](const Stranger& stranger) { return leads(owner, state_.sites[stranger.site], point); });
}

}  // namespace geom
