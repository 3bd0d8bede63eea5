#include "tools/trace_picture.h"

#include <algorithm>
#include <set>

namespace tools {

using geom::Vec2;
using geom::Vec3;

namespace {

constexpr double size = 640;  // pixels

/// One of six quiet colours, so that neighbouring cells mostly differ.
const char* colour(geom::SiteId s) {
  static constexpr const char* colours[] = {"#dbe9f6", "#fde6ce", "#dff0d8", "#f6dfe6", "#e8e2f3", "#f5f1cf"};
  return colours[s.index() % std::size(colours)];
}

}  // namespace

TracePicture::TracePicture(const geom::TriMesh& mesh, const fpo::SurfaceSample& at, double radius)
    : mesh_(mesh),
      center_(at.position),
      normal_(mesh.normal(at.facet).normalized()),
      u_((mesh.corner(at.facet, 1) - mesh.corner(at.facet, 0)).normalized()),
      v_(normal_.cross(u_)),
      radius_(radius) {}

Vec2 TracePicture::project(const Vec3& p) const {
  const Vec3 d = (p - center_) * (size / (2 * radius_));
  return {size / 2 + d.dot(u_), size / 2 - d.dot(v_)};
}

/// In the picture and seen from its front.
bool TracePicture::near(const fpo::CellPolygon& polygon) const {
  const bool in_sight = std::ranges::any_of(
      polygon.corners, [&](const Vec3& p) { return (p - center_).norm() < 1.5 * radius_; });
  return in_sight && mesh_.normal(polygon.facet).dot(normal_) > 0;
}

TracePicture::Drawing TracePicture::draw(const geom::RestrictedPower& diagram, geom::SiteId x,
                                         const geom::EmptyCircle* circle) const {
  io::Svg svg(size, size);
  svg.rectangle({0, 0}, {size, size}, R"(fill="#fff")");
  std::vector<io::GroupedPolygon> cells;
  std::set<geom::SiteId> sites;
  for (const fpo::CellPolygon& polygon : fpo::cell_polygons(diagram)) {
    if (!near(polygon)) continue;
    cells.push_back({polygon.site.value, polygon.corners});
    sites.insert(polygon.site);
    std::vector<Vec2> corners;
    for (const Vec3& p : polygon.corners) corners.push_back(project(p));
    const std::string fill = polygon.site == x ? "#f4a582" : colour(polygon.site);
    svg.polygon(corners, "fill=\"" + fill + R"(" stroke="#8899aa" stroke-width="0.6")");
  }
  for (const geom::SiteId s : sites) svg.circle(project(diagram.site(s).position), 3, R"(fill="#234")");
  svg.circle(project(diagram.site(x).position), 4.5, R"(fill="#c0392b")");
  if (circle && circle->radius2 > 0) {
    const double r = std::sqrt(circle->radius2) * size / (2 * radius_);
    svg.circle(project(circle->center), r, R"(fill="none" stroke="#c0392b" stroke-width="1.5")");
    svg.circle(project(circle->center), 2.5, R"(fill="none" stroke="#c0392b")");
  }
  return {std::move(svg), std::move(cells)};
}

void TracePicture::Drawing::save(const std::filesystem::path& stem) const {
  svg.save(stem.string() + ".svg");
  io::write_polygons(stem.string() + ".obj", "cell_", cells);
}

}  // namespace tools
