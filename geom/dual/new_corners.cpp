#include "geom/dual/new_corners.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

constexpr std::size_t group_size = 16;

}  // namespace

void NewCorners::clear() {
  corners_.clear();
  ++stamp_;
}

void NewCorners::add(FacetId t, SiteId owner, std::span<const PolygonCorner> share, std::size_t corner) {
  if (!is_first(t, owner, share[previous_corner(corner, share.size())].edge, share[corner].edge)) return;
  const WeightedPoint3& site = state_.sites[owner];
  const double distance2 = (share[corner].point.position - site.position).squaredNorm();
  corners_.push_back({cell_corner(t, owner, share, corner), distance2 - site.weight, distance2});
}

bool NewCorners::is_first(FacetId t, SiteId owner, EdgeLabel before, EdgeLabel after) {
  if ((before.is_site() && before.site() < owner) || (after.is_site() && after.site() < owner)) return false;
  if (before.is_site() && after.is_site()) return true;
  if (before.is_site() || after.is_site()) {
    const FacetId across = state_.mesh.across(t, before.is_site() ? after.edge() : before.edge());
    return !across.valid() || t < across;
  }
  std::uint32_t& stamp = stamp_of_[state_.mesh.facet(t)[static_cast<std::size_t>(after.edge())]];
  const bool is_new = stamp != stamp_;
  stamp = stamp_;
  return is_new;
}

void NewCorners::group() {
  std::ranges::stable_sort(corners_, {}, [](const Corner& c) { return c.corner.owner; });
  groups_.clear();
  for (std::size_t i = 0, end = 0; i < corners_.size(); i = end) {
    Box3 box;
    double tolerance = 0;
    for (end = i; end < std::min(i + group_size, corners_.size()) &&
                  corners_[end].corner.owner == corners_[i].corner.owner;
         ++end) {
      box.extend(corners_[end].corner.point.position);
      tolerance = std::max(tolerance, corners_[end].corner.point.tolerance);
    }
    groups_.push_back({i, end, box.center(), (0.5 * box.sizes().norm() + tolerance) * (1 + 1e-9)});
  }
}

bool NewCorners::any_beaten_by(SiteId j) const {
  return std::ranges::any_of(groups_, [&](const Group& group) {
    const std::span<const Corner> corners = std::span(corners_).subspan(group.begin, group.end - group.begin);
    return !is_behind(state_.sites[j], state_.sites[corners.front().corner.owner], group) &&
           std::ranges::any_of(corners, [&](const Corner& at) { return beats_at(j, at); });
  });
}

/// Is j farther than the owner in all of the ball?
bool NewCorners::is_behind(const WeightedPoint3& j, const WeightedPoint3& owner, const Group& ball) const {
  if (j.level != owner.level) return false;
  const double far = geom::power(ball.center, j), near = geom::power(ball.center, owner), lead = far - near;
  if (lead <= 1e-8 * (std::abs(far) + std::abs(near) + std::abs(j.weight) + std::abs(owner.weight)))
    return false;
  return lead * lead >
         4 * ball.radius * ball.radius * (1 + 1e-6) * (j.position - owner.position).squaredNorm();
}

/// The lead of the owner over j is off by some ulps of what it is made of, and by the tolerance of the corner
/// times its slope, which is twice the distance of the two sites.
bool NewCorners::beats_at(SiteId j, const Corner& at) const {
  const WeightedPoint3& site = state_.sites[j];
  const auto& [position, tolerance] = at.corner.point;
  const double distance2 = (position - site.position).squaredNorm();
  const double lead = distance2 - site.weight - at.power, scale = distance2 + at.distance2;
  if (site.level == state_.sites[at.corner.owner].level &&
      lead > 0x1p-46 * (scale + std::abs(site.weight) + std::abs(at.power)) +
                 tolerance * (3 * std::sqrt(scale) + tolerance))
    return false;
  return state_.clipper.beats_at(at.corner, j, state_.clipper.bisector_of(at.corner.owner, j));
}

}  // namespace geom
