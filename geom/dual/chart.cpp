#include "geom/dual/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double steeper = 1 + 1e-6;
constexpr double small = 1e-9;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void Chart::begin(const Sheet& sheet) {
  m_ = sheet.axis;
  u_ = sheet.u;
  v_ = m_.cross(u_);
  slope_u_ = steeper * sheet.slope_u;
  slope_v_ = steeper * sheet.slope_v;
  slope2_ = steeper * sheet.slope * sheet.slope;
  largest2_ = 0;
  size_ = 0;
}

void Chart::set(int i, const Vec3& d, double c) {
  const auto k = static_cast<std::size_t>(i);
  x_[k] = d.dot(u_);
  y_[k] = d.dot(v_);
  z_[k] = d.dot(m_);
  c_[k] = c;
  largest2_ = std::max({largest2_, d.squaredNorm(), std::abs(c)});
  largest_ = std::sqrt(largest2_);
}

// n = e x e' is steep if |n_z| > su |n_x| + sv |n_y|, which is at most 2 Z (su Y + sv X) for the largest
// components X, Y, Z.
bool Chart::is_simple_with(int last, double radius) const {
  const auto k = static_cast<std::size_t>(last);
  const double least = small * largest_, least2 = 4 * small * largest_ * largest_;
  std::array<double, most_sites> ex, ey, ez;
  double X = 0, Y = 0, Z = 0;
  for (std::size_t i = 0; i < k; ++i) {
    ex[i] = x_[i] - x_[k];
    ey[i] = y_[i] - y_[k];
    ez[i] = z_[i] - z_[k];
    X = std::max(X, std::abs(ex[i]));
    Y = std::max(Y, std::abs(ey[i]));
    Z = std::max(Z, std::abs(ez[i]));
    if (!(std::abs(ex[i]) > std::abs(ez[i]) * slope_u_ + least) &&
        !(std::abs(ey[i]) > std::abs(ez[i]) * slope_v_ + least))
      return false;
  }
  const double enough = 2 * Z * (slope_u_ * Y + slope_v_ * X) + least2;
  for (std::size_t i = 1; i < k; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double nz = std::abs(ex[j] * ey[i] - ey[j] * ex[i]);
      if (nz > enough) continue;
      const double nx = ey[j] * ez[i] - ez[j] * ey[i], ny = ez[j] * ex[i] - ex[j] * ez[i];
      if (!(nz > slope_u_ * std::abs(nx) + slope_v_ * std::abs(ny) + least2) &&
          !is_far(static_cast<int>(i), static_cast<int>(j), last, radius))
        return false;
    }
  return true;
}

bool Chart::is_monotone(int first, int second) const {
  const std::size_t i = at(first), j = at(second);
  const double least = small * largest_, rise = std::abs(z_[i] - z_[j]);
  return std::abs(x_[i] - x_[j]) > rise * slope_u_ + least ||
         std::abs(y_[i] - y_[j]) > rise * slope_v_ + least;
}

bool Chart::meets_axis_once(int first, int second, int third, double radius) const {
  const std::size_t i = at(first), j = at(second), k = at(third);
  const Vec3 e(x_[i] - x_[k], y_[i] - y_[k], z_[i] - z_[k]), f(x_[j] - x_[k], y_[j] - y_[k], z_[j] - z_[k]);
  const Vec3 n = e.cross(f).cwiseAbs();
  return n.z() > slope_u_ * n.x() + slope_v_ * n.y() + 4 * small * largest_ * largest_ ||
         is_far(first, second, third, radius);
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
  const double shrink = 1 / std::sqrt(1 + slope2_), slope = std::sqrt(slope2_);
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
  const double rise = chord.dot(m_), rise2 = rise * rise * e2 / h2, length2 = chord.squaredNorm();
  const double cosine2 = 1 - slope2_ * ez * ez / h2;  // of phi
  if (!(cosine2 > small)) return std::numeric_limits<double>::infinity();
  const double steep2 = slope2_ * (e2 / h2) / cosine2;
  const double along2 = std::max(length2 - rise2, small * length2);
  const double off = (steep2 * along2 - rise2) / (2 * std::sqrt(steep2 * along2));
  const double shift = 0.5 * std::sqrt(length2 * rise2 / (steep2 * along2));
  const double far = 0.5 * (from + to).norm() + std::max(off, 0.0) + shift;
  return steeper * std::max({from.squaredNorm(), to.squaredNorm(), far * far});
}

}  // namespace geom
