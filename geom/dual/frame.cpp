#include "geom/dual/frame.h"

#include <algorithm>
#include <limits>

#include "geom/check.h"

namespace geom {

void Frame::begin(const WeightedPoint3& origin) {
  origin_ = origin;
  size_ = padded_ = 0;
  largest2_ = largest_ = heaviest_ = 0;
  vertices_.clear();
}

void Frame::add(const WeightedPoint3& site) {
  ensure(size_ < most, "frame: too many sites");
  const Vec3 d = site.position - origin_.position;
  const double d2 = d.squaredNorm(), dw = site.weight - origin_.weight;
  dx_[size_] = d.x();
  dy_[size_] = d.y();
  dz_[size_] = d.z();
  c_[size_] = d2 - dw;
  largest2_ = std::max(largest2_, d2);
  heaviest_ = std::max(heaviest_, std::abs(dw));
  ++size_;
  if (size_ <= padded_) return;
  for (int i = padded_; i < padded_ + 4; ++i)  // evaluated four by four
    if (i >= size_) dx_[i] = dy_[i] = dz_[i] = c_[i] = 0;
  padded_ += 4;
}

Sure Frame::lead(const Vec3& y, double tolerance, const Vec3& d, double c, int i) const {
  const Vec3 di = i == none ? Vec3(0, 0, 0) : offset(i);
  const double ci = i == none ? 0 : c_[i];
  const double size = std::abs(y.x()) + std::abs(y.y()) + std::abs(y.z());
  const double d2 = std::max(largest2_, d.squaredNorm()), far = std::sqrt(d2);
  const double heavy = std::max(heaviest_, std::abs(c) + d2);  // no less than |dw|
  return {(c - ci) - 2 * (d - di).dot(y), 0x1p-47 * (d2 + heavy + far * size) + 4 * far * tolerance};
}

Frame::Slot Frame::evaluate(VertexId v) {
  if (vertices_.empty()) largest_ = std::sqrt(largest2_);
  const auto slot = static_cast<Slot>(vertices_.size());
  slot_of_[v] = slot;
  Vertex& out = vertices_.emplace_back();
  out.id = v;
  out.y = mesh_.position(v) - origin_.position;
  const double x = 2 * out.y.x(), y = 2 * out.y.y(), z = 2 * out.y.z();
  out.error = 0x1p-49 * (largest2_ + heaviest_ + 0.5 * largest_ * (std::abs(x) + std::abs(y) + std::abs(z)));
  for (int i = 0; i < padded_; i += 4)
    for (int k = i; k < i + 4; ++k) out.g[k] = c_[k] - (dx_[k] * x + dy_[k] * y + dz_[k] * z);
  double least = out.g[0], second = std::numeric_limits<double>::infinity();
  int nearest = 0;
  std::uint32_t beaten_by = least < 0, unsure = std::abs(least) <= out.error;
  for (int i = 1; i < size_; ++i) {
    const double g = out.g[i];
    beaten_by |= static_cast<std::uint32_t>(g < 0) << i;
    unsure |= std::abs(g) <= out.error;
    if (g < least) {
      second = least;
      least = g;
      nearest = i;
    } else {
      second = std::min(second, g);
    }
  }
  out.nearest = static_cast<std::int8_t>(nearest);
  out.beaten_by = beaten_by;
  out.owned = beaten_by == 0;
  out.sure = unsure == 0;
  out.sure_nearest = second - least > 4 * out.error;
  return slot;
}

}  // namespace geom
