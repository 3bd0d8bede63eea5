#include "geom/dual/slack_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double steeper = SheetAxes::steeper;
constexpr double infinite = std::numeric_limits<double>::infinity();

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void SlackChart::begin(const Sheet& sheet, double radius) {
  axes_ = SheetAxes(sheet);
  steep_ = std::sqrt(1 + axes_.slope_u * axes_.slope_u + axes_.slope_v * axes_.slope_v);
  radius_ = radius;
  size_ = 0;
}

void SlackChart::add(const Vec3& d, double off) {
  const std::size_t i = at(size_++);
  x_[i] = d.dot(axes_.u);
  y_[i] = d.dot(axes_.v);
  z_[i] = d.dot(axes_.m);
  off_[i] = 1.01 * off;
  far2_[i] = d.squaredNorm();
  lead_off_[i] = off_[i] * (2 * (radius_ + std::sqrt(far2_[i])) + off_[i]);
}

SlackChart::Difference SlackChart::difference(int i, int k) const {
  Difference e{x_[at(i)] - x_[at(k)], y_[at(i)] - y_[at(k)], z_[at(i)] - z_[at(k)], 0,
               off_[at(i)] + off_[at(k)]};
  e.length = std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
  return e;
}

bool SlackChart::is_monotone(int k) {
  for (int i = 0; i < k; ++i) {
    const Difference& e = to_[at(i)] = difference(i, k);
    const double rise = std::abs(e.z) + e.off;
    if (!(std::abs(e.x) > rise * axes_.slope_u + e.off || std::abs(e.y) > rise * axes_.slope_v + e.off))
      return false;
    const double along = std::sqrt(e.x * e.x + e.y * e.y) - e.off;
    tau2_ = along > 0 ? std::max(tau2_, rise * rise / (along * along)) : infinite;
  }
  return true;
}

bool SlackChart::meets_axis_once(int i, int j, int k) const {
  const Difference &e = to_[at(i)], &g = to_[at(j)];
  const double nx = e.y * g.z - e.z * g.y, ny = e.z * g.x - e.x * g.z, nz = e.x * g.y - e.y * g.x;
  const double off = e.off * g.length + g.off * e.length + e.off * g.off;
  if (std::abs(nz) > axes_.slope_u * std::abs(nx) + axes_.slope_v * std::abs(ny) + steep_ * off) return true;
  const double dot = e.x * g.x + e.y * g.y + e.z * g.z, both = e.length * g.length;
  const double f = far2_[at(i)] - far2_[at(k)], f2 = far2_[at(j)] - far2_[at(k)];
  const double lead = std::abs(g.length * f + (dot > 0 ? -e.length : e.length) * f2);
  const double gradient = std::sqrt(2 * both * std::max(both - std::abs(dot), 0.0));
  return lead > 2 * steeper * radius_ * (gradient + 1e-7 * both) +
                    g.length * (lead_off_[at(i)] + lead_off_[at(k)]) +
                    e.length * (lead_off_[at(j)] + lead_off_[at(k)]);
}

bool SlackChart::is_simple() {
  tau2_ = axes_.slope2;
  for (int k = 1; k < size_; ++k) {
    if (!is_monotone(k)) return false;
    for (int i = 1; i < k; ++i)
      for (int j = 0; j < i; ++j)
        if (!meets_axis_once(i, j, k)) return false;
  }
  return true;
}

bool SlackChart::is_simple_with(const Vec3& d, double off) {
  const int k = size_;
  const double tau2 = tau2_;
  add(d, off);
  bool is_simple = is_monotone(k);
  for (int i = 1; is_simple && i < k; ++i)
    for (int j = 0; is_simple && j < i; ++j) is_simple = meets_axis_once(i, j, k);
  tau2_ = tau2;
  --size_;
  return is_simple;
}

double SlackChart::steepest() const {
  const double cosine2 = 1 - axes_.slope2 * tau2_;
  return cosine2 > 1e-9 ? steeper * std::sqrt(axes_.slope2 * (1 + tau2_) / cosine2) : infinite;
}

}  // namespace geom
