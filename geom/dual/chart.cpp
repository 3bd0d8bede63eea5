#include "geom/dual/chart.h"

#include <cmath>

namespace geom {
namespace {

constexpr double more = 1 + 1e-6;
constexpr double small = 1e-9;

}  // namespace

void Chart::begin(const Sheet& sheet) {
  m_ = sheet.axis;
  u_ = sheet.u;
  v_ = m_.cross(u_);
  slope_u_ = more * sheet.slope_u;
  slope_v_ = more * sheet.slope_v;
  slope2_ = more * sheet.slope * sheet.slope;
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

bool Chart::is_simple_with(int last, double radius) const {
  const auto k = static_cast<std::size_t>(last);
  const double least = small * largest_, least2 = 4 * small * largest_ * largest_;
  std::array<double, most> ex, ey, ez, margin;
  for (std::size_t i = 0; i < k; ++i) {
    ex[i] = x_[i] - x_[k];
    ey[i] = y_[i] - y_[k];
    ez[i] = z_[i] - z_[k];
  }
  for (std::size_t i = 0; i < k; ++i) {
    const double fx = ex[i], fy = ey[i], fz = ez[i], a = std::abs(fz);
    if (!(std::abs(fx) > a * slope_u_ + least) && !(std::abs(fy) > a * slope_v_ + least)) return false;
    for (std::size_t j = 0; j < i; ++j) {
      const double nx = ey[j] * fz - ez[j] * fy, ny = ez[j] * fx - ex[j] * fz, nz = ex[j] * fy - ey[j] * fx;
      margin[j] = std::abs(nz) - (slope_u_ * std::abs(nx) + slope_v_ * std::abs(ny));
    }
    for (std::size_t j = 0; j < i; ++j)
      if (!(margin[j] > least2) && !is_far(static_cast<int>(i), static_cast<int>(j), last, radius))
        return false;
  }
  return true;
}

// The axis is where 2 e.y = f and 2 e'.y = f' for e = d_i - d_k, f = c_i - c_k, and e', f' of j: its place next to the
// origin is ((f e' - f' e) x n) / (2 |n|^2) with n = e x e', so |f e' - f' e| = 2 |n| times its distance.
bool Chart::is_far(int first, int second, int third, double radius) const {
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second),
             k = static_cast<std::size_t>(third);
  const Vec3 e(x_[i] - x_[k], y_[i] - y_[k], z_[i] - z_[k]);
  const Vec3 g(x_[j] - x_[k], y_[j] - y_[k], z_[j] - z_[k]);
  const double length = ((c_[i] - c_[k]) * g - (c_[j] - c_[k]) * e).norm();
  return length > 2 * more * radius * (e.cross(g).norm() + small * largest2_) +
                      small * largest2_ * (e.norm() + g.norm());
}

// In the plane of the bisector let w be the horizontal direction and m' the one across, tilted from m by psi,
// tan(psi) = |a| / |e_h|. There the surface has slope at most k = s / (cos(psi) cos(phi)). On a chord with components
// (t, z) a path of such slopes is farthest off at |t| (1 +- |z| / (k |t|)) / 2, by (k^2 t^2 - z^2) / (2 k |t|).
double Chart::farthest2(int first, int second, const Vec3& from, const Vec3& to) const {
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
  const double ex = x_[i] - x_[j], ey = y_[i] - y_[j], ez = z_[i] - z_[j];
  const double h2 = ex * ex + ey * ey, e2 = h2 + ez * ez;
  const Vec3 chord = to - from;
  const double rise = chord.dot(m_), rise2 = rise * rise * e2 / h2, length2 = chord.squaredNorm();
  const double steep2 = slope2_ * (e2 / h2) / std::max(1 - slope2_ * ez * ez / h2, small);
  const double along2 = std::max(length2 - rise2, small * length2);
  const double off = (steep2 * along2 - rise2) / (2 * std::sqrt(steep2 * along2));
  const double shift = 0.5 * std::sqrt(length2 * rise2 / (steep2 * along2));
  const double far = 0.5 * (from + to).norm() + std::max(off, 0.0) + shift;
  return more * std::max({from.squaredNorm(), to.squaredNorm(), far * far});
}

}  // namespace geom
