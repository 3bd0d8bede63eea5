#include "geom/rough_polygon.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

constexpr double u = 0x1p-53;

}  // namespace

void RoughPolygon::start() {
  for (std::uint32_t i = 0; i < 3; ++i) {
    lines_[i] = {EdgeLabel::facet_edge(static_cast<int>(i)), {0, 0, 0}, 0, 1};
    lines_[i].f[i == 0 ? 2 : i - 1] = 1;  // edge i runs from corner i to the next one
    corners_[i] = {{0, 0, 0}, 0, i};
    corners_[i].weights[i] = 1;
  }
  size_ = num_lines_ = 3;
}

RoughPolygon::Outcome RoughPolygon::clip(EdgeLabel label, const LinearForm& form) {
  const auto& [f0, f1, f2] = form.f;
  const double largest = std::max({std::abs(f0), std::abs(f1), std::abs(f2)}) + form.error;
  std::array<bool, most> is_lost;
  std::size_t num_lost = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    const Corner& corner = corners_[k];
    const double f = f0 * corner.weights[0] + f1 * corner.weights[1] + f2 * corner.weights[2];
    const double bound = form.error + largest * (3 * corner.off + 8 * u);
    if (!(std::abs(f) > bound)) return Outcome::unsure;
    is_lost[k] = f < 0;
    num_lost += is_lost[k];
  }
  if (num_lost == 0) return Outcome::untouched;
  if (num_lost == size_) return Outcome::swallowed;
  if (num_lines_ == most || size_ + 1 >= most) return Outcome::unsure;
  std::size_t first = 0;  // kept, after a lost one
  while (!(is_lost[previous_corner(first, size_)] && !is_lost[first])) ++first;
  std::rotate(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(first),
              corners_.begin() + static_cast<std::ptrdiff_t>(size_));
  const std::size_t kept = size_ - num_lost;
  for (std::size_t k = 0; k < size_; ++k)
    if (is_lost[(first + k) % size_] != (k >= kept)) return Outcome::unsure;  // no convex polygon
  const auto line = static_cast<std::uint32_t>(num_lines_);
  const std::uint32_t leaving = corners_[kept - 1].line, entering = corners_[size_ - 1].line;
  lines_[num_lines_++] = {label, {f0, f1, f2}, form.error, largest};
  if (!meet(leaving, line, corners_[kept]) || !meet(line, entering, corners_[kept + 1]))
    return Outcome::unsure;
  corners_[kept].line = line;
  corners_[kept + 1].line = entering;
  size_ = kept + 2;
  return Outcome::cut;
}

bool RoughPolygon::meet(std::uint32_t one, std::uint32_t two, Corner& out) const {
  const auto& [label, f, e1, m1] = lines_[one];
  const auto& [other, g, e2, m2] = lines_[two];
  const double l0 = f[1] * g[2] - f[2] * g[1], l1 = f[2] * g[0] - f[0] * g[2], l2 = f[0] * g[1] - f[1] * g[0];
  const double sum = l0 + l1 + l2;
  const double e = 2 * (m1 * e2 + m2 * e1) + 4 * u * m1 * m2, all = 4 * e + 12 * u * m1 * m2;
  if (!(std::abs(sum) > 4 * all)) return false;
  const double inverse = 1 / sum;
  out.weights = {l0 * inverse, l1 * inverse, l2 * inverse};
  out.off = 1.01 * all * std::abs(inverse) + 8 * u;
  return true;
}

}  // namespace geom
