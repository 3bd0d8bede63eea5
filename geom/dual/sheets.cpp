#include "geom/dual/sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geom {
namespace {

constexpr double cell_size = 0.5;      // of a level's radius
constexpr double reach_factor = 1.65;  // R, likewise
constexpr double more = 1 + 1e-6;
constexpr double steepest = 0.7075;  // cosine: a slope less than 1
constexpr double flat_enough = 0.98;
constexpr int axis_rounds = 8;
constexpr std::size_t most_places = 1 << 20, most_listed = 1 << 25;  // then they are made anew

/// Does the triangle come within that distance of the origin? Rounded.
bool comes_within(double limit2, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double height = normal.dot(a);
  if (height * height > limit2 * normal.squaredNorm() * (1 + 1e-9)) return false;
  const auto beside = [&](const Vec3& from, const Vec3& to) { return from.cross(to).dot(normal) < 0; };
  const auto near_edge = [&](const Vec3& from, const Vec3& to) {
    const Vec3 d = to - from;
    const double along = -from.dot(d), length2 = d.squaredNorm();
    if (along <= 0) return from.squaredNorm() <= limit2;
    if (along >= length2) return to.squaredNorm() <= limit2;
    return from.squaredNorm() * length2 - along * along <= limit2 * length2;
  };
  const bool ab = beside(a, b), bc = beside(b, c), ca = beside(c, a);
  if (!ab && !bc && !ca) return true;  // the foot of the perpendicular is inside
  return (ab && near_edge(a, b)) || (bc && near_edge(b, c)) || (ca && near_edge(c, a));
}

/// The squared distance of x from the segment.
double distance2(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((x - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (a + t * d - x).squaredNorm();
}

}  // namespace

Sheets::Sheet& Sheets::at(const Vec3& p, double distance, double& level_radius) {
  if (!(distance <= level_radius_ &&
        level_radius_ < 1.6 * distance)) {  // else the level of the last place will do
    int exponent = 0;
    const double mantissa = std::frexp(distance, &exponent);
    const auto step =
        static_cast<int>(std::ceil(4 * std::log2(mantissa) - 1e-6));  // levels a factor 2^(1/4) apart
    level_ = 4 * exponent + step;
    level_radius_ = std::exp2(0.25 * level_) * more;
  }
  level_radius = level_radius_;
  Key key{level_, {}};
  for (int i = 0; i < 3; ++i)
    key.cell[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::floor(p[i] / (cell_size * level_radius)));
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
  const Sheet& place = at(p, distance, level_radius);
  if (place.width < 0 || !(distance * more + (p - place.center).norm() * more < place.width)) return false;
  const double factor = 4 * more * place.slope * distance;
  return std::ranges::all_of(link, [&](const Neighbour& q) {
    const double size = q.offset.squaredNorm();
    return q.lead > 1e-9 * size && q.lead > factor * std::abs(q.offset.dot(place.axis)) + 1e-9 * size;
  });
}

std::span<const FacetId> Sheets::facets_within(const Vec3& p, double distance) {
  double level_radius = 0;
  Sheet& place = at(p, distance, level_radius);
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
  return std::span(lists_).subspan(static_cast<std::size_t>(place.first),
                                   static_cast<std::size_t>(place.last - place.first));
}

void Sheets::make(Sheet& place, double radius) {
  near_.clear();
  normals_.clear();
  facets_.near(place.center, radius * more, near_);
  Vec3 axis(0, 0, 0);
  std::size_t count = 0;
  for (const FacetId t : near_) {
    const Vec3 a = mesh_.corner(t, 0) - place.center, b = mesh_.corner(t, 1) - place.center,
               c = mesh_.corner(t, 2) - place.center;
    const Vec3 ab = b - a, ac = c - a, n = ab.cross(ac);
    if (!comes_within(radius * radius * more, a, b, c, n)) continue;
    const double length2 = n.squaredNorm();
    if (!(length2 > 1e-16 * ab.squaredNorm() * ac.squaredNorm()))
      return;  // a needle: its normal is off by more than 1e-7
    normals_.push_back(n / std::sqrt(length2));
    if (normals_.back().dot(normals_.front()) < 0) return;  // more than 45 degrees from any axis, one of them
    axis += normals_.back();
    near_[count++] = t;
  }
  near_.resize(count);
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
  if (hangs_together(place.center, radius))
    place.width = radius / std::sqrt(1 + place.slope * place.slope) / more;
}

/// Premises (2) and (3) for the facets in near_.
bool Sheets::hangs_together(const Vec3& center, double radius) {
  ++stamp_;
  for (const FacetId t : near_) stamp_of_[t] = 2 * stamp_;  // even: near, not reached
  const auto reach = [&](FacetId t) {
    stamp_of_[t] = 2 * stamp_ + 1;
    stack_.push_back(t);
  };
  stack_.clear();
  reach(near_.front());
  std::size_t count = 0;
  while (!stack_.empty()) {
    const FacetId t = stack_.back();
    stack_.pop_back();
    ++count;
    for (int e = 0; e < 3; ++e) {
      const FacetId across = mesh_.across(t, e);
      const bool is_reached = across.valid() && stamp_of_[across] == 2 * stamp_ + 1;
      if (is_reached ||
          distance2(center, mesh_.corner(t, e), mesh_.corner(t, e == 2 ? 0 : e + 1)) > radius * radius)
        continue;
      if (!across.valid()) return false;
      if (stamp_of_[across] == 2 * stamp_) reach(across);
    }
  }
  return count == near_.size();
}

}  // namespace geom
