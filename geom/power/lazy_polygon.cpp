#include "geom/power/lazy_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double u = 0x1p-53;
constexpr double undecided = std::numeric_limits<double>::infinity();

}  // namespace

void LazyPolygon::start(FacetId facet, SiteId owner) {
  facet_ = facet;
  owner_ = owner;
  lines_.resize(3);
  corners_.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    lines_[i] = {EdgeLabel::facet_edge(static_cast<int>(i)), {0, 0, 0}, 0, 1};
    lines_[i].f[i == 0 ? 2 : i - 1] = 1;  // edge i runs from corner i to the next one
    corners_[i] = {{0, 0, 0}, 0, i, false};
    corners_[i].weights[i] = 1;
  }
}

Clip LazyPolygon::cut(SiteId j, const Bisector& b, bool is_loser_beaten) {
  const auto [f, error] = clipper_.form_on(facet_, b);
  const double largest = std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])}) + error;
  const std::size_t size = corners_.size();
  std::size_t kept = size;
  for (std::size_t k = 0; k < size; ++k) {
    Corner& corner = corners_[k];
    const double value = f[0] * corner.weights[0] + f[1] * corner.weights[1] + f[2] * corner.weights[2];
    const bool is_certain = std::abs(value) > error + largest * (3 * corner.off + 8 * u);
    corner.is_lost = (is_certain ? value < 0 : is_beaten_exactly(k, j)) == is_loser_beaten;
    kept -= corner.is_lost;
  }
  if (kept == size) return Clip::untouched;
  if (kept == 0) return Clip::swallowed;
  std::size_t first = 0;  // kept, after a lost one
  while (!(corners_[previous_corner(first, size)].is_lost && !corners_[first].is_lost)) ++first;
  left_.resize(kept + 2);
  std::size_t at = first;
  for (std::size_t k = 0; k < size; ++k, at = at + 1 == size ? 0 : at + 1) {
    ensure(corners_[at].is_lost == (k >= kept), "clip: beaten corners are not consecutive");
    if (k < kept) left_[k] = corners_[at];
  }
  const auto line = static_cast<std::uint32_t>(lines_.size());
  const std::uint32_t entering = corners_[previous_corner(first, size)].line;
  lines_.push_back({EdgeLabel::bisector(j), {f[0], f[1], f[2]}, error, largest});
  left_[kept] = meet(left_[kept - 1].line, line, line);
  left_[kept + 1] = meet(line, entering, entering);
  corners_.swap(left_);
  return Clip::cut;
}

bool LazyPolygon::is_beaten_exactly(std::size_t k, SiteId j) const {
  return clipper_.beats_exactly(
      {facet_, owner_, label(previous_corner(k, corners_.size())), label(k), RoundedPoint()}, j);
}

/// Where two lines meet; the edge from there on lies on the line `next`.
LazyPolygon::Corner LazyPolygon::meet(std::uint32_t one, std::uint32_t two, std::uint32_t next) const {
  const auto& [label, f, e1, m1] = lines_[one];
  const auto& [other, g, e2, m2] = lines_[two];
  const double l0 = f[1] * g[2] - f[2] * g[1], l1 = f[2] * g[0] - f[0] * g[2], l2 = f[0] * g[1] - f[1] * g[0];
  const double sum = l0 + l1 + l2;
  const double e = 2 * (m1 * e2 + m2 * e1) + 4 * u * m1 * m2, all = 4 * e + 12 * u * m1 * m2;
  if (!(std::abs(sum) > 4 * all)) return {{0, 0, 0}, undecided, next, false};
  const double inverse = 1 / sum;
  return {{l0 * inverse, l1 * inverse, l2 * inverse}, 1.01 * all * std::abs(inverse) + 8 * u, next, false};
}

}  // namespace geom
