#include "geom/dual/frame.h"

#include <algorithm>

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
template <int count, bool with_levels>
bool is_behind_one_of(const Frame::Coefficients& of, const Frame::Seen& site, double base,
                      const Frame::Place& center, double limit2) {
  const double x = site.d.x(), y = site.d.y(), z = site.d.z(), mx = 2 * center.y.x(), my = 2 * center.y.y(),
               mz = 2 * center.y.z();
  double margin[count];
  for (int k = 0; k < count; ++k) {
    const double ax = x - of.dx[k], ay = y - of.dy[k], az = z - of.dz[k];
    double lead = base - (of.c[k] - (of.dx[k] * mx + of.dy[k] * my + of.dz[k] * mz));
    double apart2 = ax * ax + ay * ay + az * az;
    if constexpr (with_levels) {
      lead += 2 * of.rise[k] * center.rise;
      apart2 += (site.rise - of.rise[k]) * (site.rise - of.rise[k]);
    }
    margin[k] = lead * std::abs(lead) - limit2 * apart2;
  }
  for (const double m : margin)
    if (m > 0) return true;
  return false;
}

}  // namespace

void Frame::begin(const WeightedPoint3& origin) {
  origin_ = origin;
  size_ = 0;
  is_level_ = true;
  largest2_ = largest_ = heaviest_ = 0;
  std::ranges::fill(of_.c, very_far);  // wherever others have been
}

void Frame::add(const WeightedPoint3& site) {
  ensure(size_ < most, "frame: too many sites");
  const Vec3 d = site.position - origin_.position;
  const double rise = site.level - origin_.level, d2 = d.squaredNorm() + rise * rise,
               dw = site.weight - origin_.weight;
  of_.dx[size_] = d.x();
  of_.dy[size_] = d.y();
  of_.dz[size_] = d.z();
  of_.c[size_] = d2 - dw;
  of_.rise[size_] = rise;
  is_level_ &= rise == 0;
  if (d2 > largest2_) {
    largest2_ = d2;
    largest_ = std::sqrt(d2);
  }
  heaviest_ = std::max(heaviest_, std::abs(dw));
  ++size_;
}

double Frame::error_at(const Vec3& twice_y, double twice_rise) const {
  if (is_level_) return 0x1p-49 * (largest2_ + heaviest_ + 0.5 * largest_ * twice_y.lpNorm<1>());
  const double size = twice_y.lpNorm<1>() + std::abs(twice_rise);
  return 0x1.8p-49 * (largest2_ + heaviest_ + 0.5 * largest_ * size);
}

void Frame::evaluate(const Place& at, double off, Values& out) const {
  const Vec3 twice = 2 * at.y;
  const double twice_rise = 2 * at.rise;
  out.y = at.y;
  out.rise = at.rise;
  out.error = error_at(twice, twice_rise) + 2 * largest_ * off;
  out.size = size_;
  if (size_ <= few)
    fill<few>(of_, twice, out.g);
  else
    fill<most>(of_, twice, out.g);
  for (int k = 0; !is_level_ && k < size_; ++k) out.g[k] -= of_.rise[k] * twice_rise;
  out.g[most] = 0;
}

// The lead of site i is affine, hence in the ball at least what it is at the center less 2 |d - d_i| times
// the radius.
bool Frame::is_behind(const Seen& site, const Place& center, double radius, int first) const {
  const double d2 = site.d.squaredNorm() + site.rise * site.rise, limit2 = 4 * (1 + 1e-6) * radius * radius;
  const double base = site.c - 2 * (site.d.dot(center.y) + site.rise * center.rise) -
                      1e-9 * (d2 + largest2_ + heaviest_ + std::abs(site.c));
  if (first != nobody) {
    const Seen other = seen(first);
    const double lead = base - (other.c - 2 * (other.d.dot(center.y) + other.rise * center.rise));
    const double apart = site.rise - other.rise;
    if (lead * std::abs(lead) > limit2 * ((site.d - other.d).squaredNorm() + apart * apart)) return true;
  }
  if (!is_level_ || site.rise != 0) return is_behind_one_of<most, true>(of_, site, base, center, limit2);
  return size_ <= few ? is_behind_one_of<few, false>(of_, site, base, center, limit2)
                      : is_behind_one_of<most, false>(of_, site, base, center, limit2);
}

// The nearer of two is at most at the mean of their powers, which is affine, too: as that of a site whose d
// and c are the means.
bool Frame::is_behind_two(const Seen& site, const Place& center, double radius) const {
  const double limit2 = 4 * (1 + 1e-6) * radius * radius;
  const double d2 = site.d.squaredNorm() + site.rise * site.rise;
  const double base = site.c - 2 * (site.d.dot(center.y) + site.rise * center.rise) -
                      1e-9 * (d2 + largest2_ + heaviest_ + std::abs(site.c));
  for (int i = 0; i < size_; ++i) {
    const int j = i + 1 == size_ ? 0 : i + 1;
    const Vec3 mean = 0.5 * (offset(i) + offset(j));
    const double rise = 0.5 * (of_.rise[i] + of_.rise[j]), apart = site.rise - rise;
    const double lead = base - (0.5 * (of_.c[i] + of_.c[j]) - 2 * (mean.dot(center.y) + rise * center.rise));
    if (lead * std::abs(lead) > limit2 * ((site.d - mean).squaredNorm() + apart * apart)) return true;
  }
  return false;
}

Sure Frame::difference(const Values& at, const Seen& site, int j) const {
  const double d2 = site.d.squaredNorm() + site.rise * site.rise, far2 = std::max(d2, largest2_);
  const double size = std::abs(at.y.x()) + std::abs(at.y.y()) + std::abs(at.y.z()) + std::abs(at.rise);
  const double heavy = std::abs(site.c) + d2 + heaviest_;  // no less than |dw|
  // what `off` adds to the error of the frame's sites counts for a farther one in proportion
  const double scale = largest2_ > 0 ? 1 + far2 / largest2_ : 2;
  return {(site.c - 2 * (site.d.dot(at.y) + site.rise * at.rise)) - at.g[Values::at(j)],
          4 * scale * at.error + 0x1p-47 * (far2 + heavy + std::sqrt(far2) * size)};
}

}  // namespace geom
