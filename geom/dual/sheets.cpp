#include "geom/dual/sheets.h"

#include <algorithm>
#include <cmath>

#include "geom/aabb_tree.h"

namespace geom {
namespace {

constexpr double cell_size = 0.25;  // of a level's radius
constexpr double more = 1 + 1e-6;
constexpr int axis_rounds = 12;
constexpr double reach_factor = 1.65;  // of the radius: enough for slopes up to .57, mostly more

/// The squared distance of x from the segment.
double distance2(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((x - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (a + t * d - x).squaredNorm();
}

}  // namespace

const Sheet& Sheets::around(const Vec3& p, double radius) {
  int exponent = 0;
  const double mantissa = std::frexp(radius, &exponent);  // levels a factor sqrt(2) apart
  const bool half = mantissa <= std::sqrt(0.5);
  const double level_radius = std::ldexp(half ? std::sqrt(0.5) : 1.0, exponent), cell = cell_size * level_radius;
  Key key{2 * exponent - half, {}};
  for (int i = 0; i < 3; ++i) key.cell[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::floor(p[i] / cell));
  const auto [place, is_new] = places_.try_emplace(key);
  if (is_new) place->second = make(p, reach_factor * level_radius);
  return place->second;
}

bool Sheets::has_one_component(const Vec3& p, double distance, std::span<const Neighbour> link) {
  const Sheet& sheet = around(p, distance);
  if (!(distance * more + (p - sheet.center).norm() * more < sheet.width)) return false;
  const double factor = 4 * more * sheet.slope * distance;
  return std::ranges::all_of(link, [&](const Neighbour& q) {
    const double size = q.offset.squaredNorm();
    return q.lead > 0 && q.lead > factor * (std::abs(q.offset.dot(sheet.axis)) + 1e-12 * std::sqrt(size)) + 1e-9 * size;
  });
}

Sheet Sheets::make(const Vec3& center, double radius) {
  near_.clear();
  facets_.near(center, radius * more, near_);
  std::erase_if(near_, [&](FacetId t) {
    const std::array<Vec3, 3> q{mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
    return closest_point(center, q).distance2 > radius * radius * more;
  });
  Sheet sheet;
  sheet.center = center;
  std::vector<Vec3> normals;
  Vec3 axis(0, 0, 0);
  for (const FacetId t : near_) {
    const Vec3 n = mesh_.normal(t);
    const double length = n.norm();
    const double sides = (mesh_.corner(t, 1) - mesh_.corner(t, 0)).norm() * (mesh_.corner(t, 2) - mesh_.corner(t, 0)).norm();
    if (!(length > 1e-8 * sides)) return sheet;  // a needle, whose normal is rounded by more than 1e-7
    normals.push_back(n / length);
    axis += normals.back();
  }
  if (normals.empty() || !(axis.norm() > 1e-9)) return sheet;
  axis.normalize();
  // towards the middle of the smallest cone about the normals
  double best = -1;
  for (int round = 1; round <= axis_rounds; ++round) {
    const auto far = std::ranges::min_element(normals, {}, [&](const Vec3& n) { return n.dot(axis); });
    if (const double cosine = far->dot(axis); cosine > best) {
      best = cosine;
      sheet.axis = axis;
    }
    if (best > 0.999) break;
    const Vec3 turned = axis + (*far - axis) / (round + 1);
    if (!(turned.norm() > 1e-9)) break;
    axis = turned.normalized();
  }
  if (!(best > std::sqrt(0.5))) return sheet;
  sheet.slope = more * std::sqrt(std::max(0.0, 1 - best * best)) / best + 1e-9;
  if (sheet.slope < 0.999 && hangs_together(center, radius))
    sheet.width = radius / std::sqrt(1 + sheet.slope * sheet.slope) / more;
  return sheet;
}

/// Premises (2) and (3) for the facets in near_.
bool Sheets::hangs_together(const Vec3& center, double radius) {
  std::ranges::sort(near_);
  reached_.assign(near_.size(), false);
  stack_.assign(1, near_.front());
  reached_[0] = true;
  std::size_t count = 1;
  while (!stack_.empty()) {
    const FacetId t = stack_.back();
    stack_.pop_back();
    for (int e = 0; e < 3; ++e) {
      if (distance2(center, mesh_.corner(t, e), mesh_.corner(t, e == 2 ? 0 : e + 1)) > radius * radius) continue;
      const FacetId across = mesh_.across(t, e);
      if (!across.valid()) return false;
      const auto at = std::ranges::lower_bound(near_, across);
      if (at == near_.end() || *at != across) continue;
      char& reached = reached_[static_cast<std::size_t>(at - near_.begin())];
      if (reached) continue;
      reached = true;
      ++count;
      stack_.push_back(across);
    }
  }
  return count == near_.size();
}

}  // namespace geom
