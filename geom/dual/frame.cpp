#include "geom/dual/frame.h"

#include <limits>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double very_far = 1e100;

}  // namespace

void Frame::begin(const WeightedPoint3& origin) {
  origin_ = origin;
  size_ = 0;
  largest2_ = largest_ = heaviest_ = 0;
  vertices_.clear();
  for (int i = 0; i < most; ++i) {
    dx_[i] = dy_[i] = dz_[i] = 0;
    c_[i] = very_far;
  }
}

void Frame::add(const WeightedPoint3& site) {
  ensure(size_ < most, "frame: too many sites");
  const Vec3 d = site.position - origin_.position;
  const double d2 = d.squaredNorm(), dw = site.weight - origin_.weight;
  dx_[size_] = d.x();
  dy_[size_] = d.y();
  dz_[size_] = d.z();
  c_[size_] = d2 - dw;
  if (d2 > largest2_) {
    largest2_ = d2;
    largest_ = std::sqrt(d2);
  }
  heaviest_ = std::max(heaviest_, std::abs(dw));
  ++size_;
}

void Frame::add_late(const WeightedPoint3& site) {
  add(site);
  const int i = size_ - 1;
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    Vertex& v = vertices_[k];
    v.g[i] = c_[i] - (dx_[i] * (2 * v.y.x()) + dy_[i] * (2 * v.y.y()) + dz_[i] * (2 * v.y.z()));
    v.error = error_at(2 * v.y);
    v.has_signs = false;
  }
}

double Frame::error_at(const Vec3& twice_y) const {
  return 0x1p-49 * (largest2_ + heaviest_ + 0.5 * largest_ * twice_y.lpNorm<1>());
}

void Frame::evaluate(const Vec3& y, double off, Values& out) const {
  const double x2 = 2 * y.x(), y2 = 2 * y.y(), z2 = 2 * y.z();
  out.y = y;
  out.error = error_at(2 * y) + 2 * largest_ * off;
  if (size_ <= 8)
    fill<8>(x2, y2, z2, out.g);
  else
    fill<most>(x2, y2, z2, out.g);
  out.g[most] = 0;
}

/// So many at once, two by two.
template <int count>
void Frame::fill(double x2, double y2, double z2, double* out) const {
  double g[count];
  for (int k = 0; k < count; ++k) g[k] = c_[k] - (dx_[k] * x2 + dy_[k] * y2 + dz_[k] * z2);
  for (int k = 0; k < count; ++k) out[k] = g[k];
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
  return size_ <= 8 ? is_behind_one_of<8>(d, base, 2 * center, limit2)
                    : is_behind_one_of<most>(d, base, 2 * center, limit2);
}

template <int count>
bool Frame::is_behind_one_of(const Vec3& d, double base, const Vec3& twice_center, double limit2) const {
  const double x = d.x(), y = d.y(), z = d.z(), mx = twice_center.x(), my = twice_center.y(),
               mz = twice_center.z();
  double margin[count];
  for (int k = 0; k < count; ++k) {
    const double ax = x - dx_[k], ay = y - dy_[k], az = z - dz_[k];
    const double lead = base - (c_[k] - (dx_[k] * mx + dy_[k] * my + dz_[k] * mz));
    margin[k] = lead * std::abs(lead) - limit2 * (ax * ax + ay * ay + az * az);
  }
  for (const double m : margin)
    if (m > 0) return true;
  return false;
}

// The nearer of two is at most at the mean of their powers, which is affine, too: as that of a site whose d
// and c are the means.
bool Frame::is_behind_two(const Vec3& d, double c, const Vec3& center, double radius) const {
  const double limit2 = 4 * (1 + 1e-6) * radius * radius;
  const double base = c - 2 * d.dot(center) - 1e-9 * (d.squaredNorm() + largest2_ + heaviest_ + std::abs(c));
  for (int i = 0; i < size_; ++i) {
    const int j = i + 1 == size_ ? 0 : i + 1;
    const Vec3 mean = 0.5 * (offset(i) + offset(j));
    const double lead = base - (0.5 * (c_[i] + c_[j]) - 2 * mean.dot(center));
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

Frame::Slot Frame::evaluate(VertexId v) {
  const auto slot = static_cast<Slot>(vertices_.size());
  slot_of_[v] = slot;
  Vertex& out = vertices_.add();
  out.id = v;
  evaluate(mesh_.position(v) - origin_.position, 0, out);
  out.has_signs = false;
  return slot;
}

void Frame::find_signs(Vertex& v) const {
  double closest_to_0 = std::numeric_limits<double>::infinity();
  v.beaten_by = 0;
  for (int i = 0; i < size_; ++i) {
    v.beaten_by |= static_cast<std::uint32_t>(v.g[i] < 0) << i;
    closest_to_0 = std::min(closest_to_0, std::abs(v.g[i]));
  }
  v.sure = closest_to_0 > v.error;
  v.has_signs = true;
}

int Frame::nearest(const Vertex& v) const {
  int nearest = 0;
  for (int i = 1; i < size_; ++i)
    if (v.g[i] < v.g[nearest]) nearest = i;
  for (int i = 0; i < size_; ++i)
    if (i != nearest && !v.nearer(nearest, i)) return -1;
  return nearest;
}

}  // namespace geom
