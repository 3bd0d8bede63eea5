#include "fpo/spectrum/spectrum_point.h"

#include <algorithm>

namespace fpo {

using geom::Vec2;
using geom::Vec3;

double surface_length(const SpectrumPoint& a, const SpectrumPoint& b) {
  const Vec3 d = b.position - a.position;
  const double length = d.norm();
  if (length == 0) return 0;
  const double c1 = std::clamp(a.normal.dot(d) / length, -1.0, 1.0);
  const double c2 = std::clamp(b.normal.dot(d) / length, -1.0, 1.0);
  const double apart = c1 - c2;
  // Below this the quotient has lost digits, and its limit at the mean is off by about apart^2.
  if (std::abs(apart) < 1e-5) {
    const double c = (c1 + c2) / 2;
    return length / std::sqrt(1 - c * c);
  }
  return length * (std::asin(c1) - std::asin(c2)) / apart;
}

std::optional<Vec2> differential(const SpectrumPoint& a, const TangentFrame& frame_of_a,
                                 const SpectrumPoint& b) {
  if (a.normal.dot(b.normal) < 0) return std::nullopt;
  const Vec3 d = b.position - a.position;
  if (d.squaredNorm() == 0) return Vec2(0, 0);
  const Vec2 tangential(frame_of_a.first.dot(d), frame_of_a.second.dot(d));
  const double size = tangential.norm();
  if (size == 0) return std::nullopt;
  const double scaled = surface_length(a, b) * 2 / (a.spacing + b.spacing);
  if (!std::isfinite(scaled)) return std::nullopt;
  return Vec2(tangential * (scaled / size));
}

}  // namespace fpo
