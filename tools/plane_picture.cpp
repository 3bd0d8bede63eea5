#include "tools/plane_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace tools {
namespace {

using fpo::PlaneDomain;
using geom::CellId;
using geom::Regular2;
using geom::SiteId;
using geom::Vec2;

/// A torus on paper: y upwards, a shape shown wherever a copy of it meets the rectangle.
class Sheet {
 public:
  Sheet(const Vec2& period, double width)
      : period_(period), scale_(width / period.x()), svg_(width, period.y() * scale_) {}

  io::Svg& svg() { return svg_; }
  double scale() const { return scale_; }
  Vec2 size() const { return period_ * scale_; }

  /// Calls draw(corners in pixels) for each copy of a shape that meets the rectangle.
  template <class Draw>
  void each_copy(const std::vector<Vec2>& shape, double margin, Draw&& draw) const {
    Vec2 low = shape[0], high = shape[0];
    for (const Vec2& p : shape) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    std::vector<Vec2> copy(shape.size());
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const Vec2 by(i * period_.x(), j * period_.y());
        if (((high + by).array() < -margin).any() || ((low + by - period_).array() > margin).any()) continue;
        std::transform(shape.begin(), shape.end(), copy.begin(), [&](const Vec2& p) {
          return Vec2((p + by).x() * scale_, (period_.y() - (p + by).y()) * scale_);
        });
        draw(copy);
      }
    }
  }

 private:
  Vec2 period_;
  double scale_;
  io::Svg svg_;
};

std::string colour_of(double share) {
  const auto mix = [&](int blue_end, int middle, int red_end) {
    const double t = 2 * share;
    const double c = t < 1 ? blue_end + t * (middle - blue_end) : middle + (t - 1) * (red_end - middle);
    return static_cast<int>(std::lround(c));
  };
  char text[32];
  std::snprintf(text, sizeof text, "fill=\"#%02x%02x%02x\"", mix(74, 245, 214), mix(123, 240, 96),
                mix(183, 225, 77));
  return text;
}

std::vector<Vec2> power_cell(const Regular2& t, SiteId x) {
  const Vec2 at = t.point(x).position;
  std::vector<Vec2> corners;
  t.visit_star(x, [&](CellId c, int) { corners.push_back(at + t.torus().shortest(t.center(c) - at)); });
  return corners;
}

void draw_cells(Sheet& sheet, const PlaneDomain& domain, bool colour) {
  double least = INFINITY, most = 0;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    least = std::min(least, domain.edge_length(SiteId(i)));
    most = std::max(most, domain.edge_length(SiteId(i)));
  }
  sheet.svg().begin_group(R"(fill="none" stroke="#8899aa" stroke-width="0.6" stroke-linejoin="round")");
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const SiteId x(i);
    if (domain.triangulation().is_hidden(x)) continue;
    const double range = std::log(most / least);
    const double share = range > 0 ? std::log(domain.edge_length(x) / least) / range : 0.5;
    sheet.each_copy(power_cell(domain.triangulation(), x), 0, [&](const std::vector<Vec2>& corners) {
      sheet.svg().polygon(corners, colour ? colour_of(share) : "");
    });
  }
  sheet.svg().end_group();
}

void draw_disks(Sheet& sheet, const PlaneDomain& domain) {
  sheet.svg().begin_group(R"(fill="#4a7bb7" fill-opacity="0.25" stroke="#4a7bb7" stroke-width="0.5")");
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const geom::WeightedPoint2 p = domain.triangulation().point(SiteId(i));
    const double radius = p.weight > 0 ? std::sqrt(p.weight) : domain.edge_length(SiteId(i)) / 2;
    sheet.each_copy({p.position}, radius,
                    [&](const std::vector<Vec2>& at) { sheet.svg().circle(at[0], radius * sheet.scale()); });
  }
  sheet.svg().end_group();
}

void draw_triangulation(Sheet& sheet, const Regular2& t) {
  io::SvgPath path;
  for (const Regular2::Triangle& corner : t.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const SiteId a = corner[k], b = corner[(k + 1) % 3];
      if (b < a) continue;  // the triangle beyond draws it
      const Vec2 from = t.point(a).position;
      sheet.each_copy({from, from + t.difference(a, b)}, 0,
                      [&](const std::vector<Vec2>& ends) { path.polyline(ends); });
    }
  }
  sheet.svg().path(path, R"(fill="none" stroke="#556677" stroke-width="0.7")");
}

void draw_points(Sheet& sheet, const PlaneDomain& domain) {
  const double radius =
      std::clamp(0.16 * std::sqrt(sheet.size().prod() / static_cast<double>(domain.num_samples())), 0.4, 2.5);
  io::SvgPath path;
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    sheet.each_copy({domain.triangulation().point(SiteId(i)).position}, radius / sheet.scale(),
                    [&](const std::vector<Vec2>& at) { path.dot(at[0]); });
  char style[96];
  std::snprintf(style, sizeof style, R"(stroke="#111" stroke-linecap="round" stroke-width="%.2f")",
                2 * radius);
  sheet.svg().path(path, style);
}

}  // namespace

io::Svg draw_plane(const fpo::PlaneDomain& domain, const PlanePicture& picture) {
  Sheet sheet(domain.torus().period(), picture.width);
  sheet.svg().rectangle({0, 0}, sheet.size(), R"(fill="#fff")");
  if (picture.cells || picture.colour) draw_cells(sheet, domain, picture.colour);
  if (picture.disks) draw_disks(sheet, domain);
  if (picture.triangulation) draw_triangulation(sheet, domain.triangulation());
  draw_points(sheet, domain);
  return sheet.svg();
}

}  // namespace tools
