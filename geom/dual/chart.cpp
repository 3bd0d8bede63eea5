#include "geom/dual/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double steeper = SheetAxes::steeper;
constexpr double small = 1e-9;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void Chart::begin(const Sheet& sheet) {
  axes_ = SheetAxes(sheet);
  largest2_ = 0;
  size_ = 0;
}

void Chart::set(int i, const Vec3& d, double c) {
  const std::size_t k = at(i);
  const double dx = d.x(), dy = d.y(), dz = d.z();
  x_[k] = dx * axes_.u[0] + dy * axes_.u[1] + dz * axes_.u[2];
  y_[k] = dx * axes_.v[0] + dy * axes_.v[1] + dz * axes_.v[2];
  z_[k] = dx * axes_.m[0] + dy * axes_.m[1] + dz * axes_.m[2];
  c_[k] = c;
  largest2_ = std::max(std::max(largest2_, dx * dx + dy * dy + dz * dz), std::abs(c));
}

// |n_z| > su |n_x| + sv |n_y| if |n_z| is more than 2 Z (su Y + sv X) for the largest components X, Y, Z of e
// and e'.
Chart::Spread Chart::spread(int count) const {
  const auto width = [count](const auto& of) {
    double least = of[0], most = of[0];
    for (std::size_t i = 1; i < at(count); ++i) {
      least = std::min(least, of[i]);
      most = std::max(most, of[i]);
    }
    return most - least;
  };
  const double X = width(x_), Y = width(y_), Z = width(z_), least = small * largest();
  return {2 * Z * (axes_.slope_u * Y + axes_.slope_v * X) + 4 * small * largest2_, axes_.slope_u * Z + least,
          axes_.slope_v * Z + least};
}

// n_z of three sites is twice the area of their triangle: the sum of those of its sides with any location.
bool Chart::is_simple(int count, std::span<const Edge> edges, double radius) const {
  const Spread wide = spread(count + 1);
  const double x = x_[at(count)], y = y_[at(count)];
  std::array<std::array<double, most_sites>, most_sites> area;
  for (int i = 1; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      if (!is_pair_fine(i, j, wide)) return false;
      area[at(i)][at(j)] = (x_[at(j)] - x) * (y_[at(i)] - y) - (y_[at(j)] - y) * (x_[at(i)] - x);
    }
  const auto is_wide = [&wide](double nz) { return std::abs(nz) > wide.enough; };
  for (const auto& [i, j] : edges)
    if (!is_wide(area[at(std::max(i, j))][at(std::min(i, j))]) && !meets_axis_once(i, j, count, radius))
      return false;
  for (int i = 2; i < count; ++i)
    for (int j = 1; j < i; ++j)
      for (int k = 0; k < j; ++k) {
        const double nz = area[at(j)][at(k)] + area[at(i)][at(j)] - area[at(i)][at(k)];
        if (!is_wide(nz) && !meets_axis_once(i, j, k, radius)) return false;
      }
  return true;
}

bool Chart::is_simple_with(int last, double radius) const {
  const Spread wide = spread(last + 1);
  std::array<double, most_sites> ex, ey;
  const double x = x_[at(last)], y = y_[at(last)];
  for (int i = 0; i < last; ++i) {
    if (!is_pair_fine(i, last, wide)) return false;
    ex[at(i)] = x_[at(i)] - x;
    ey[at(i)] = y_[at(i)] - y;
  }
  for (int i = 1; i < last; ++i)
    for (int j = 0; j < i; ++j) {
      const double nz = ex[at(j)] * ey[at(i)] - ey[at(j)] * ex[at(i)];
      if (!(std::abs(nz) > wide.enough) && !meets_axis_once(i, j, last, radius)) return false;
    }
  return true;
}

bool Chart::is_monotone(int first, int second) const {
  const std::size_t i = at(first), j = at(second);
  const double least = small * largest(), rise = std::abs(z_[i] - z_[j]);
  return std::abs(x_[i] - x_[j]) > rise * axes_.slope_u + least ||
         std::abs(y_[i] - y_[j]) > rise * axes_.slope_v + least;
}

bool Chart::meets_axis_once(int first, int second, int third, double radius) const {
  const std::size_t i = at(first), j = at(second), k = at(third);
  const double ex = x_[i] - x_[k], ey = y_[i] - y_[k], ez = z_[i] - z_[k];
  const double fx = x_[j] - x_[k], fy = y_[j] - y_[k], fz = z_[j] - z_[k];
  const double nx = std::abs(ey * fz - ez * fy), ny = std::abs(ez * fx - ex * fz),
               nz = std::abs(ex * fy - ey * fx);
  return nz > axes_.slope_u * nx + axes_.slope_v * ny + 4 * small * largest2_ ||
         is_far(first, second, third, radius);
}

bool Chart::meets_axes_once(int site, std::span<const Edge> edges, double radius) const {
  for (const auto& [a, b] : edges)
    if (a != site && b != site && !meets_axis_once(a, b, site, radius)) return false;
  return true;
}

// The axis is where 2 e.y = f and 2 e'.y = f' for e = d_i - d_k, f = c_i - c_k, and e', f' of j: its place
// next to the origin is ((f e' - f' e) x n) / (2 |n|^2) with n = e x e', so |f e' - f' e| = 2 |n| times its
// distance.
bool Chart::is_far(int first, int second, int third, double radius) const {
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second),
             k = static_cast<std::size_t>(third);
  const Vec3 e(x_[i] - x_[k], y_[i] - y_[k], z_[i] - z_[k]);
  const Vec3 g(x_[j] - x_[k], y_[j] - y_[k], z_[j] - z_[k]);
  const double length = ((c_[i] - c_[k]) * g - (c_[j] - c_[k]) * e).norm();
  return length > 2 * steeper * radius * (e.cross(g).norm() + small * largest2_) +
                      small * largest2_ * (e.norm() + g.norm());
}

// A location y at horizontal distance t lies, seen from above, between two neighbours; one is within half the
// angle of them, gamma. For that one 2 d.y >= 2 t (|d_h| cos(gamma) - s|a|), where |y| / sqrt(1 + s^2) <= t
// <= |y|. So with |y| given its power is at most |y|^2 - w + c - 2 |y| C: convex in |y|, as is |y| plus the
// root of that and of the heaviest weight. Both are largest at 0 or at the radius.
Chart::Gain Chart::most_gain(int count, double radius, double weight, double heaviest) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double shrink = 1 / std::sqrt(1 + axes_.slope2), slope = std::sqrt(axes_.slope2);
  std::array<double, most_sites> length, half;  // of site i; the cosine from i to the next one
  for (int j = 0; j < count; ++j) length[at(j)] = std::sqrt(x_[at(j)] * x_[at(j)] + y_[at(j)] * y_[at(j)]);
  for (int j = 0; j < count; ++j) {
    const std::size_t a = at(j), b = at(j + 1 == count ? 0 : j + 1);
    if (!(x_[a] * y_[b] - y_[a] * x_[b] > 0)) return {infinity, infinity};
    const double cosine = (x_[a] * x_[b] + y_[a] * y_[b]) / (length[a] * length[b]);
    half[a] = std::sqrt(std::max(0.5 * (1 + cosine), 0.0)) / steeper;
  }
  double most_far = -infinity, most_c = most_far;
  for (int j = 0; j < count; ++j) {
    const std::size_t i = at(j);
    const double falls =
        length[i] * std::min(half[i], half[at(j == 0 ? count - 1 : j - 1)]) - slope * std::abs(z_[i]);
    const double far = radius * radius + c_[i] - 2 * radius * (falls > 0 ? falls * shrink : falls);
    most_far = std::max(most_far, far);
    most_c = std::max(most_c, c_[i]);
  }
  const auto distance = [&](double c) { return std::sqrt(std::max(c - weight + heaviest, 0.0)); };
  const Gain most{std::max(most_c, most_far), std::max(distance(most_c), radius + distance(most_far))};
  const double slack = 1e-9 * (std::abs(most.power) + std::abs(weight) + radius * radius);
  return {steeper * most.power + slack - weight, steeper * most.range + std::sqrt(slack)};
}

// Of the pairs the one with the largest |a| / |e_h| counts: k^2 = s^2 (1 + tau^2) / (1 - s^2 tau^2) for that
// ratio tau (farthest2).
double Chart::steepest(std::span<const Edge> edges) const {
  double tau2 = axes_.slope2;
  for (const auto& [first, second] : edges) {
    const std::size_t i = at(first), j = at(second);
    const double ex = x_[i] - x_[j], ey = y_[i] - y_[j], ez = z_[i] - z_[j];
    const double h2 = ex * ex + ey * ey, a2 = ez * ez;
    if (!(a2 <= tau2 * h2)) tau2 = a2 / h2;
  }
  const double cosine2 = 1 - axes_.slope2 * tau2;
  if (!(cosine2 > small)) return std::numeric_limits<double>::infinity();
  return steeper * std::sqrt(axes_.slope2 * (1 + tau2) / cosine2);
}

// In the plane of the bisector let w be the horizontal direction and m' the one across, tilted from m by psi,
// tan(psi) = |a| / |e_h|. A normal within s of m, at an angle b around it, gives the surface the slope s
// cos(b) / (cos(psi) - s sin(b) sin(psi)) there: at most k = s / (cos(psi) cos(phi)), where sin(phi) = s
// tan(psi). On a chord with components (t, z) a path of such slopes is farthest off at |t| (1 +- |z| / (k
// |t|)) / 2, by (k^2 t^2 - z^2) / (2 k |t|); that place of the chord is |z| / (2 k) times its length over |t|
// from the middle.
double Chart::farthest2(int first, int second, const Vec3& from, const Vec3& to) const {
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
  const double ex = x_[i] - x_[j], ey = y_[i] - y_[j], ez = z_[i] - z_[j];
  const double h2 = ex * ex + ey * ey, e2 = h2 + ez * ez;
  const Vec3 chord = to - from;
  const double rise = chord.dot(axes_.m), rise2 = rise * rise * e2 / h2, length2 = chord.squaredNorm();
  const double cosine2 = 1 - axes_.slope2 * ez * ez / h2;  // of phi
  if (!(cosine2 > small)) return std::numeric_limits<double>::infinity();
  const double steep2 = axes_.slope2 * (e2 / h2) / cosine2;
  const double along2 = std::max(length2 - rise2, small * length2);
  const double off = (steep2 * along2 - rise2) / (2 * std::sqrt(steep2 * along2));
  const double shift = 0.5 * std::sqrt(length2 * rise2 / (steep2 * along2));
  const double far = 0.5 * (from + to).norm() + std::max(off, 0.0) + shift;
  return steeper * std::max({from.squaredNorm(), to.squaredNorm(), far * far});
}

}  // namespace geom
