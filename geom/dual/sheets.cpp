#include "geom/dual/sheets.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

constexpr double radii[] = {1.6, 1.25, 1.08};  // R, in distances that are to be covered: one after the other
constexpr double nearly_there = 0.3, nearly_so = 0.85;  // of a distance for which there is no sheet
constexpr double ample = 1 + 2e-6;   // a millionth, and the 2^-24 of a rounding to float many times over
constexpr double steepest = 0.7075;  // cosine: a slope less than 1
constexpr double flat_enough = 0.98;
constexpr int axis_rounds = 8;

/// Does the triangle come within that distance of the origin? Rounded.
bool comes_within(double limit2, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  if (a.squaredNorm() <= limit2 || b.squaredNorm() <= limit2 || c.squaredNorm() <= limit2) return true;
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

Sheets::Sheets(const TriMesh& mesh, const FacetTree& facets, const FacetBalls& balls)
    : mesh_(mesh), facets_(facets), balls_(balls), stamp_of_(mesh.num_facets(), 0) {
  normal_of_.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const Vec3 ab = mesh.corner(t, 1) - mesh.corner(t, 0), ac = mesh.corner(t, 2) - mesh.corner(t, 0),
               n = ab.cross(ac);
    const double length2 = n.squaredNorm();
    const bool is_needle = !(length2 > 1e-16 * ab.squaredNorm() * ac.squaredNorm());
    normal_of_.push_back(is_needle ? Vec3(0, 0, 0) : Vec3(n / std::sqrt(length2)));
  }
}

/// The place of the site, which another may have had.
Sheets::OfSite& Sheets::of_site(SiteId site) {
  const std::size_t i = site.index() % most_kept;
  if (i >= kept_.size()) kept_.resize(i + 1);
  OfSite& place = kept_[i];
  if (place.site != site) {
    place = OfSite();
    place.site = site;
  }
  return place;
}

const Sheet* Sheets::around(SiteId site, const Location3& at, double distance) {
  const Vec3& x = at.position;
  OfSite& known = of_site(site);
  if (known.sheet.level == at.level && known.sheet.covers(x, distance)) return &known.sheet;
  if (static_cast<float>(at.level) == known.failed_level && distance > nearly_so * double{known.failed} &&
      (x - known.failed_at.cast<double>()).norm() < nearly_there * distance)
    return nullptr;
  gathered_.clear();
  facets_.near(at, radii[0] * distance * ample, gathered_);
  for (const double factor : radii) {
    const Sheet found = sheet_among_gathered(at, factor * distance);
    if (!found.covers(x, distance)) continue;
    known.sheet = found;
    known.failed = std::numeric_limits<float>::infinity();
    return &known.sheet;
  }
  known.failed = static_cast<float>(distance);
  known.failed_at = x.cast<float>();
  known.failed_level = static_cast<float>(at.level);
  return nullptr;
}

void Sheets::keep(SiteId site, const Sheet& sheet) { of_site(site).sheet = sheet; }

bool Sheets::has_one_component(const Sheet& sheet, double radius, std::span<const Neighbour> link) {
  const double factor = 4 * ample * sheet.slope * radius;
  return std::ranges::all_of(link, [&](const Neighbour& q) {
    const double size = q.offset.squaredNorm();
    return q.lead > 1e-9 * size && q.lead > factor * std::abs(q.offset.dot(sheet.axis)) + 1e-9 * size;
  });
}

Sheet Sheets::sheet_in(const Location3& center, double radius) {
  gathered_.clear();
  facets_.near(center, radius * ample, gathered_);
  return sheet_among_gathered(center, radius);
}

Sheet Sheets::sheet_among_gathered(const Location3& center, double radius) {
  Sheet place;
  place.center = center.position;
  place.level = center.level;
  if (!keep_near(center, radius) || !find_axis(place)) return place;
  find_slopes(place, radius);
  if (!hangs_together(place.center, radius)) place.width = -1;
  return place;
}

/// What the ball about the facet says; a little more may count as within.
Sheets::Within Sheets::compare(FacetId t, const Vec3& center, double radius) const {
  const double own = balls_.radius(t), beyond = (radius + own) * ample, short_of = radius - own;
  const double distance2 = (balls_.middle(t) - center).squaredNorm();
  if (distance2 > beyond * beyond) return Within::no;
  return short_of > 0 && distance2 <= short_of * short_of ? Within::whole : Within::partly;
}

/// Sets near_ and normals_, of the facets that were gathered. False: no sheet.
bool Sheets::keep_near(const Location3& center, double radius) {
  const double limit2 = radius * radius * ample;
  const FacetLevels& levels = balls_.levels();
  near_.clear();
  normals_.clear();
  for (const FacetId t : gathered_) {
    const Within within = compare(t, center.position, radius);
    if (within == Within::no) continue;
    if (within == Within::partly) {
      const Vec3 a = mesh_.corner(t, 0) - center.position, b = mesh_.corner(t, 1) - center.position,
                 c = mesh_.corner(t, 2) - center.position;
      if (!comes_within(limit2, a, b, c, (b - a).cross(c - a))) continue;
    }
    if (!levels.empty()) {
      if (levels.gap(t, center.level) > radius * ample) continue;
      if (!levels.is_flat_at(t, center.level)) return false;
    }
    const Vec3& n = normal_of_[t];
    normals_.push_back(n);
    if (!(n.dot(normals_.front()) > 0)) return false;  // a needle, or more than 45 degrees from any axis
    near_.push_back(t);
  }
  return !normals_.empty();
}

/// Towards the middle of the smallest cone about the normals. False: they have none that is narrow enough.
bool Sheets::find_axis(Sheet& sheet) const {
  Vec3 axis(0, 0, 0);
  for (const Vec3& n : normals_) axis += n;
  if (!(axis.norm() > 1e-9)) return false;
  axis.normalize();
  double cosine = -1;
  for (int round = 1; round <= axis_rounds; ++round) {
    Vec3 far = normals_.front();
    double least = 2;
    for (const Vec3& n : normals_)
      if (const double here = n.dot(axis); here < least) least = here, far = n;
    if (least > cosine) {
      cosine = least;
      sheet.axis = axis;
    }
    if (cosine > flat_enough) break;
    const Vec3 turned = axis + (far - axis) / (round + 1);
    if (!(turned.norm() > 1e-9)) break;
    axis = turned.normalized();
  }
  return cosine > steepest;
}

/// The rest, of the facets in near_ and their normals, given the axis.
void Sheets::find_slopes(Sheet& sheet, double radius) {
  const Vec3 &m = sheet.axis, across = std::abs(m.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  Vec3 u = across.cross(m).normalized(), v = m.cross(u);
  double uu = 0, uv = 0, vv = 0;
  gradients_.clear();
  for (const Vec3& n : normals_) {
    const double z = 1 / n.dot(m), x = n.dot(u) * z, y = n.dot(v) * z;
    gradients_.emplace_back(x, y);
    uu += x * x;
    uv += x * y;
    vv += y * y;
  }
  const double angle = 0.5 * std::atan2(2 * uv, uu - vv);  // of the gradients, the most along u
  const double cosine = std::cos(angle), sine = std::sin(angle);
  sheet.u = cosine * u + sine * v;
  double most_u = 0, most_v = 0, most2 = 0, most_height = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const double x = gradients_[i].x(), y = gradients_[i].y(), slope2 = x * x + y * y;
    most_u = std::max(most_u, std::abs(cosine * x + sine * y));
    most_v = std::max(most_v, std::abs(cosine * y - sine * x));
    most2 = std::max(most2, slope2);
    // In its plane the facet is in a ball about the foot of its middle; the plane rises by `slope` at most.
    const Vec3 &n = normals_[i], middle = balls_.middle(near_[i]) - sheet.center,
               corner = mesh_.corner(near_[i], 0) - sheet.center;
    const double slope = std::sqrt(slope2), rise = slope * balls_.radius(near_[i]), up = n.dot(m);
    const double plane = corner.dot(n) / up;  // above the center
    const double foot = middle.dot(m) - (middle - corner).dot(n) * up;
    most_height = std::max({most_height, std::min(foot + rise, plane + slope * radius),
                            -std::max(foot - rise, plane - slope * radius)});
  }
  const auto bound = [](double value, double tiny) { return static_cast<float>(ample * value + tiny); };
  sheet.slope_u = bound(most_u, 1e-9);
  sheet.slope_v = bound(most_v, 1e-9);
  sheet.slope = bound(std::sqrt(most2), 1e-9);
  sheet.height = bound(most_height, 1e-9 * radius);
  const double height = sheet.height, width2 = radius * radius - height * height;
  sheet.width = width2 > 0 ? static_cast<float>(std::sqrt(width2) / ample) : -1;
}

/// Premises (2) and (3) for the facets in near_.
bool Sheets::hangs_together(const Vec3& center, double radius) {
  ++stamp_;
  for (const FacetId t : near_) stamp_of_[t] = 2 * stamp_;  // even: near, not reached
  const auto reach = [&](FacetId t) {
    stamp_of_[t] = 2 * stamp_ + 1;
    stack_.push_back(t);
  };
  const auto meets_ball = [&](FacetId t, int e) {
    const Vec3 &from = mesh_.corner(t, e), &to = mesh_.corner(t, e == 2 ? 0 : e + 1);
    return (from - center).squaredNorm() <= radius * radius || distance2(center, from, to) <= radius * radius;
  };
  stack_.clear();
  reach(near_.front());
  std::size_t count = 0;
  while (!stack_.empty()) {
    const FacetId t = stack_.back();
    stack_.pop_back();
    ++count;
    const bool is_whole = compare(t, center, radius) == Within::whole;
    for (int e = 0; e < 3; ++e) {
      const FacetId across = mesh_.across(t, e);
      const bool is_reached = across.valid() && stamp_of_[across] == 2 * stamp_ + 1;
      if (is_reached || !(is_whole || meets_ball(t, e))) continue;
      if (!across.valid()) return false;
      if (stamp_of_[across] == 2 * stamp_) reach(across);
    }
  }
  return count == near_.size();
}

}  // namespace geom
