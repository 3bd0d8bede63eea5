#include "geom/dual/frame.h"

#include "geom/check.h"

namespace geom {
namespace {

constexpr double very_far = 1e100;

/// The values of so many at once, two by two.
template <int count>
void fill(const Frame::Coefficients& of, const Vec3& twice, double* out) {
  const double x2 = twice.x(), y2 = twice.y(), z2 = twice.z();
  double g[count];
  for (int k = 0; k < count; ++k) g[k] = of.c[k] - (of.dx[k] * x2 + of.dy[k] * y2 + of.dz[k] * z2);
  for (int k = 0; k < count; ++k) out[k] = g[k];
}

/// Has the site a lead over one of these in all of the ball? `base`: of its lead over the origin.
template <int count>
bool is_behind_one_of(const Frame::Coefficients& of, const Vec3& d, double base, const Vec3& twice_center,
                      double limit2) {
  const double x = d.x(), y = d.y(), z = d.z(), mx = twice_center.x(), my = twice_center.y(),
               mz = twice_center.z();
  double margin[count];
  for (int k = 0; k < count; ++k) {
    const double ax = x - of.dx[k], ay = y - of.dy[k], az = z - of.dz[k];
    const double lead = base - (of.c[k] - (of.dx[k] * mx + of.dy[k] * my + of.dz[k] * mz));
    margin[k] = lead * std::abs(lead) - limit2 * (ax * ax + ay * ay + az * az);
  }
  for (const double m : margin)
    if (m > 0) return true;
  return false;
}

}  // namespace

void Frame::begin(const WeightedPoint3& origin) {
  origin_ = origin;
  size_ = 0;
  largest2_ = largest_ = heaviest_ = 0;
  for (int i = 0; i < most; ++i) {
    of_.dx[i] = of_.dy[i] = of_.dz[i] = 0;
    of_.c[i] = very_far;
  }
}

void Frame::add(const WeightedPoint3& site) {
  ensure(size_ < most, "frame: too many sites");
  const Vec3 d = site.position - origin_.position;
  const double d2 = d.squaredNorm(), dw = site.weight - origin_.weight;
  of_.dx[size_] = d.x();
  of_.dy[size_] = d.y();
  of_.dz[size_] = d.z();
  of_.c[size_] = d2 - dw;
  if (d2 > largest2_) {
    largest2_ = d2;
    largest_ = std::sqrt(d2);
  }
  heaviest_ = std::max(heaviest_, std::abs(dw));
  ++size_;
}

double Frame::error_at(const Vec3& twice_y) const {
  return 0x1p-49 * (largest2_ + heaviest_ + 0.5 * largest_ * twice_y.lpNorm<1>());
}

void Frame::evaluate(const Vec3& y, double off, Values& out) const {
  out.y = y;
  out.error = error_at(2 * y) + 2 * largest_ * off;
  out.size = size_;
  if (size_ <= few)
    fill<few>(of_, 2 * y, out.g);
  else
    fill<most>(of_, 2 * y, out.g);
  out.g[most] = 0;
}

// The lead of site i is affine, hence in the ball at least what it is at the center less 2 |d - d_i| times
// the radius.
bool Frame::is_behind(const Vec3& d, double c, const Vec3& center, double radius, int first) const {
  const double d2 = d.squaredNorm(), limit2 = 4 * (1 + 1e-6) * radius * radius;
  const double base = c - 2 * d.dot(center) - 1e-9 * (d2 + largest2_ + heaviest_ + std::abs(c));
  if (first != nobody) {
    const Vec3 o = offset(first);
    const double lead = base - (constant(first) - 2 * o.dot(center));
    if (lead * std::abs(lead) > limit2 * (d - o).squaredNorm()) return true;
  }
  return size_ <= few ? is_behind_one_of<few>(of_, d, base, 2 * center, limit2)
                      : is_behind_one_of<most>(of_, d, base, 2 * center, limit2);
}

// The nearer of two is at most at the mean of their powers, which is affine, too: as that of a site whose d
// and c are the means.
bool Frame::is_behind_two(const Vec3& d, double c, const Vec3& center, double radius) const {
  const double limit2 = 4 * (1 + 1e-6) * radius * radius;
  const double base = c - 2 * d.dot(center) - 1e-9 * (d.squaredNorm() + largest2_ + heaviest_ + std::abs(c));
  for (int i = 0; i < size_; ++i) {
    const int j = i + 1 == size_ ? 0 : i + 1;
    const Vec3 mean = 0.5 * (offset(i) + offset(j));
    const double lead = base - (0.5 * (of_.c[i] + of_.c[j]) - 2 * mean.dot(center));
    if (lead * std::abs(lead) > limit2 * (d - mean).squaredNorm()) return true;
  }
  return false;
}

Sure Frame::difference(const Values& at, const Vec3& d, double c, int j) const {
  const double d2 = d.squaredNorm(), far2 = std::max(d2, largest2_);
  const double size = std::abs(at.y.x()) + std::abs(at.y.y()) + std::abs(at.y.z());
  const double heavy = std::abs(c) + d2 + heaviest_;  // no less than |dw|
  // what `off` adds to the error of the frame's sites counts for a farther one in proportion
  const double scale = largest2_ > 0 ? 1 + far2 / largest2_ : 2;
  return {(c - 2 * d.dot(at.y)) - at.g[Values::at(j)],
          4 * scale * at.error + 0x1p-47 * (far2 + heavy + std::sqrt(far2) * size)};
}

}  // namespace geom
