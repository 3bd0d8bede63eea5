#include "geom/dual/sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geom/aabb_tree.h"

namespace geom {
namespace {

constexpr double cell_size = 0.5;      // of a level's radius
constexpr double reach_factor = 1.65;  // R, likewise
constexpr double more = 1 + 1e-6;
constexpr double steepest = 0.7075;    // cosine: a slope less than 1
constexpr double flat_enough = 0.98;
constexpr int axis_rounds = 8;
constexpr std::size_t most_places = 1 << 20, most_listed = 1 << 25;  // then they are made anew

/// The squared distance of x from the segment.
double distance2(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((x - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (a + t * d - x).squaredNorm();
}

}  // namespace

Sheets::Place& Sheets::at(const Vec3& p, double distance, double& level_radius) {
  int exponent = 0;
  const double mantissa = std::frexp(distance, &exponent);  // levels a factor sqrt(2) apart
  const bool half = mantissa <= std::numbers::sqrt2 / 2;
  level_radius = std::ldexp(half ? std::numbers::sqrt2 / 2 : 1.0, exponent);
  Key key{2 * exponent - half, {}};
  for (int i = 0; i < 3; ++i)
    key.cell[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::floor(p[i] / (cell_size * level_radius)));
  if (places_.size() > most_places) {
    places_.clear();
    lists_.clear();
  }
  const auto [place, is_new] = places_.try_emplace(key);
  if (is_new) {
    place->second.center = p;
    make(place->second, reach_factor * level_radius);
  }
  return place->second;
}

bool Sheets::has_one_component(const Vec3& p, double distance, std::span<const Neighbour> link) {
  double level_radius = 0;
  const Place& place = at(p, distance, level_radius);
  if (place.width < 0 || !(distance * more + (p - place.center).norm() * more < place.width)) return false;
  const double factor = 4 * more * place.slope * distance;
  return std::ranges::all_of(link, [&](const Neighbour& q) {
    const double size = q.offset.squaredNorm();
    return q.lead > 1e-9 * size && q.lead > factor * std::abs(q.offset.dot(place.axis)) + 1e-9 * size;
  });
}

std::span<const FacetId> Sheets::facets_within(const Vec3& p, double distance) {
  double level_radius = 0;
  Place& place = at(p, distance, level_radius);
  const double diagonal = std::numbers::sqrt3 * cell_size * level_radius;  // p and the center are in one cell
  if (place.first < 0) {
    near_.clear();
    facets_.near(place.center, (level_radius + diagonal) * more, near_);
    if (lists_.size() + near_.size() > most_listed) {
      for (auto& [key, other] : places_) other.first = other.last = -1;
      lists_.clear();
    }
    place.first = static_cast<std::int32_t>(lists_.size());
    lists_.insert(lists_.end(), near_.begin(), near_.end());
    place.last = static_cast<std::int32_t>(lists_.size());
  }
  return std::span(lists_).subspan(static_cast<std::size_t>(place.first), static_cast<std::size_t>(place.last - place.first));
}

void Sheets::make(Place& place, double radius) {
  near_.clear();
  normals_.clear();
  facets_.near(place.center, radius * more, near_);
  std::erase_if(near_, [&](FacetId t) {
    const std::array<Vec3, 3> q{mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
    return closest_point(place.center, q).distance2 > radius * radius * more;
  });
  Vec3 axis(0, 0, 0);
  for (const FacetId t : near_) {
    const Vec3 n = mesh_.normal(t);
    const double length = n.norm();
    const double sides =
        (mesh_.corner(t, 1) - mesh_.corner(t, 0)).norm() * (mesh_.corner(t, 2) - mesh_.corner(t, 0)).norm();
    if (!(length > 1e-8 * sides)) return;  // a needle, whose normal is rounded by more than 1e-7
    normals_.push_back(n / length);
    axis += normals_.back();
  }
  if (normals_.empty() || !(axis.norm() > 1e-9)) return;
  axis.normalize();
  double cosine = -1;  // towards the middle of the smallest cone about the normals
  for (int round = 1; round <= axis_rounds; ++round) {
    const auto far = std::ranges::min_element(normals_, {}, [&](const Vec3& n) { return n.dot(axis); });
    if (far->dot(axis) > cosine) {
      cosine = far->dot(axis);
      place.axis = axis;
    }
    if (cosine > flat_enough) break;
    const Vec3 turned = axis + (*far - axis) / (round + 1);
    if (!(turned.norm() > 1e-9)) break;
    axis = turned.normalized();
  }
  if (!(cosine > steepest)) return;
  place.slope = more * std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine + 1e-9;
  if (hangs_together(place.center, radius)) place.width = radius / std::sqrt(1 + place.slope * place.slope) / more;
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
