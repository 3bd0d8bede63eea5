#include "tools/plane_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tools/worded.h"

namespace tools {
namespace {

using fpo::PlaneDomain;
using geom::Regular2;
using geom::SimplexId;
using geom::SiteId;
using geom::Vec2;

/// What there is to draw, of a torus or a rectangle.
struct Drawing {
  Vec2 size;
  bool periodic;
  std::vector<Vec2> points;
  std::vector<double> edge_length, radius;  ///< wanted length and radius of the disk, of each point
  std::vector<std::pair<std::size_t, std::vector<Vec2>>> cells;  ///< parts of a point's cell
  std::vector<std::array<Vec2, 2>> borders;                      ///< of cells
  std::vector<std::array<Vec2, 2>> edges;                        ///< of the triangulation
};

/// The rectangle on paper: y upwards, of a torus a shape shown wherever a copy of it meets the rectangle.
class Sheet {
 public:
  Sheet(const Vec2& period, bool periodic, double width)
      : period_(period),
        reach_(periodic ? 1 : 0),
        scale_(width / period.x()),
        svg_(width, period.y() * scale_) {}

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
    for (int i = -reach_; i <= reach_; ++i) {
      for (int j = -reach_; j <= reach_; ++j) {
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
  int reach_;  ///< copies on each side
  double scale_;
  io::Svg svg_;
};

std::string colour_of(double share) {
  const auto mix = [&](int blue_end, int middle, int red_end) {
    const double t = 2 * share;
    const double c = t < 1 ? blue_end + t * (middle - blue_end) : middle + (t - 1) * (red_end - middle);
    return static_cast<int>(std::lround(c));
  };
  return worded("fill=\"#%02x%02x%02x\"", mix(74, 245, 214), mix(123, 240, 96), mix(183, 225, 77));
}

Drawing drawing_of(const PlaneDomain& domain) {
  const Regular2& t = domain.triangulation();
  Drawing scene{domain.torus().period(), true, {}, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const SiteId x(i);
    const geom::WeightedPoint2 p = t.point(x);
    scene.points.push_back(p.position);
    scene.edge_length.push_back(domain.edge_length(x));
    scene.radius.push_back(p.weight > 0 ? std::sqrt(p.weight) : domain.edge_length(x) / 2);
    if (t.is_hidden(x)) continue;
    std::vector<Vec2> corners;
    t.visit_star(x, [&](SimplexId c, int) {
      corners.push_back(p.position + t.torus().shortest(t.center(c) - p.position));
    });
    for (std::size_t k = 0; k < corners.size(); ++k)
      scene.borders.push_back({corners[k], corners[(k + 1) % corners.size()]});
    scene.cells.emplace_back(i, std::move(corners));
  }
  for (const Regular2::Triangle& corner : t.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const SiteId a = corner[k], b = corner[(k + 1) % 3];
      if (b < a) continue;  // the triangle beyond draws it
      const Vec2 from = t.point(a).position;
      scene.edges.push_back({from, from + t.difference(a, b)});
    }
  }
  return scene;
}

/// Of a cell in parts the sides that no other part of it has.
void add_borders(Drawing& scene) {
  using Side = std::array<double, 4>;
  std::set<std::pair<std::size_t, Side>> sides;
  const auto each_side = [&](auto&& visit) {
    for (const auto& [owner, corners] : scene.cells)
      for (std::size_t k = 0; k < corners.size(); ++k)
        visit(owner, corners[k], corners[(k + 1) % corners.size()]);
  };
  each_side([&](std::size_t owner, const Vec2& a, const Vec2& b) {
    sides.insert({owner, {a.x(), a.y(), b.x(), b.y()}});
  });
  each_side([&](std::size_t owner, const Vec2& a, const Vec2& b) {
    if (!sides.contains({owner, {b.x(), b.y(), a.x(), a.y()}})) scene.borders.push_back({a, b});
  });
}

Drawing drawing_of(const fpo::RemeshResult& result, const Vec2& size) {
  Drawing scene{size, false, {}, {}, {}, {}, {}, {}};
  const auto flat = [](const geom::Vec3& x) -> Vec2 { return x.head<2>(); };
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    scene.points.push_back(flat(result.samples[i].position));
    scene.edge_length.push_back(result.wanted[geom::VertexId(i)]);
    scene.radius.push_back(result.wanted[geom::VertexId(i)] / 2);
  }
  for (const fpo::CellPolygon& cell : result.cells) {
    auto& corners = scene.cells.emplace_back(cell.site.index(), std::vector<Vec2>()).second;
    for (const geom::Vec3& x : cell.corners) corners.push_back(flat(x));
  }
  add_borders(scene);
  for (std::size_t t = 0; t < result.mesh.num_facets(); ++t) {
    const geom::FacetId facet(t);
    for (int e = 0; e < 3; ++e) {
      const geom::FacetId beyond = result.mesh.across(facet, e);
      if (beyond.valid() && beyond < facet) continue;
      scene.edges.push_back(
          {flat(result.mesh.corner(facet, e)), flat(result.mesh.corner(facet, (e + 1) % 3))});
    }
  }
  return scene;
}

void draw_lines(Sheet& sheet, const std::vector<std::array<Vec2, 2>>& lines, const std::string& style) {
  io::SvgPath path;
  for (const auto& [from, to] : lines)
    sheet.each_copy({from, to}, 0, [&](const std::vector<Vec2>& ends) { path.polyline(ends); });
  sheet.svg().path(path, R"(fill="none" stroke-linejoin="round" )" + style);
}

void draw_colours(Sheet& sheet, const Drawing& scene) {
  const auto [least, most] = std::ranges::minmax(scene.edge_length);
  const double range = std::log(most / least);
  sheet.svg().begin_group(R"(stroke="none" shape-rendering="crispEdges")");
  for (const auto& [owner, corners] : scene.cells) {
    const double share = range > 0 ? std::log(scene.edge_length[owner] / least) / range : 0.5;
    sheet.each_copy(corners, 0,
                    [&](const std::vector<Vec2>& copy) { sheet.svg().polygon(copy, colour_of(share)); });
  }
  sheet.svg().end_group();
}

void draw_disks(Sheet& sheet, const Drawing& scene) {
  sheet.svg().begin_group(R"(fill="#4a7bb7" fill-opacity="0.25" stroke="#4a7bb7" stroke-width="0.5")");
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const double radius = scene.radius[i];
    sheet.each_copy({scene.points[i]}, radius,
                    [&](const std::vector<Vec2>& at) { sheet.svg().circle(at[0], radius * sheet.scale()); });
  }
  sheet.svg().end_group();
}

void draw_points(Sheet& sheet, const Drawing& scene) {
  const double radius =
      std::clamp(0.16 * std::sqrt(sheet.size().prod() / static_cast<double>(scene.points.size())), 0.4, 2.5);
  io::SvgPath path;
  for (const Vec2& x : scene.points)
    sheet.each_copy({x}, radius / sheet.scale(), [&](const std::vector<Vec2>& at) { path.dot(at[0]); });
  sheet.svg().path(path, worded(R"(stroke="#111" stroke-linecap="round" stroke-width="%.2f")", 2 * radius));
}

io::Svg draw(const Drawing& scene, const PlanePicture& picture) {
  Sheet sheet(scene.size, scene.periodic, picture.width);
  sheet.svg().rectangle({0, 0}, sheet.size(), R"(fill="#fff")");
  if (picture.colour) draw_colours(sheet, scene);
  if (picture.cells) draw_lines(sheet, scene.borders, R"(stroke="#8899aa" stroke-width="0.6")");
  if (picture.disks) draw_disks(sheet, scene);
  if (picture.triangulation) draw_lines(sheet, scene.edges, R"(stroke="#556677" stroke-width="0.7")");
  draw_points(sheet, scene);
  return sheet.svg();
}

}  // namespace

io::Svg draw_plane(const PlaneDomain& domain, const PlanePicture& picture) {
  return draw(drawing_of(domain), picture);
}

io::Svg draw_rectangle(const fpo::RemeshResult& result, const Vec2& size, const PlanePicture& picture) {
  return draw(drawing_of(result, size), picture);
}

}  // namespace tools
