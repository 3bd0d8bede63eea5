#include "tools/trace_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "geom/mesh/aabb_tree.h"

namespace tools {

using geom::Vec2;
using geom::Vec3;

namespace {

constexpr double size = 640;  // pixels
constexpr double caption_height = 46;

/// One of six quiet colours, so that neighbouring cells mostly differ.
const char* colour(geom::SiteId s) {
  static constexpr const char* colours[] = {"#dbe9f6", "#fde6ce", "#dff0d8", "#f6dfe6", "#e8e2f3", "#f5f1cf"};
  return colours[s.index() % std::size(colours)];
}

/// Above the caption.
bool is_framed(const Vec2& at) { return at.minCoeff() >= 0 && at.maxCoeff() <= size; }

/// Whether a point of the surface lies in a part of a cell, up to rounding.
bool holds(const fpo::CellPolygon& polygon, const geom::TriMesh& mesh, const Vec3& p) {
  const Vec3 normal = mesh.normal(polygon.facet).normalized();
  const double tolerance = 1e-7 * mesh.diagonal();
  if (std::abs((p - polygon.corners[0]).dot(normal)) > tolerance) return false;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vec3& a = polygon.corners[i];
    const Vec3 side = (polygon.corners[(i + 1) % polygon.corners.size()] - a).normalized();
    if (normal.cross(side).dot(p - a) < -tolerance) return false;
  }
  return true;
}

}  // namespace

TracePicture::TracePicture(const geom::TriMesh& mesh, const fpo::SurfaceSample& at, double radius)
    : mesh_(mesh),
      center_(at.position),
      normal_(mesh.normal(at.facet).normalized()),
      u_((mesh.corner(at.facet, 1) - mesh.corner(at.facet, 0)).normalized()),
      v_(normal_.cross(u_)),
      radius_(radius) {
  find_sheet(at.facet);
}

Vec2 TracePicture::project(const Vec3& p) const {
  const Vec3 d = (p - center_) * (size / (2 * radius_));
  return {size / 2 + d.dot(u_), size / 2 - d.dot(v_)};
}

bool TracePicture::in_sight(geom::FacetId t) const {
  const std::array<Vec3, 3> corners{mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
  return mesh_.normal(t).dot(normal_) > 0 &&
         (geom::closest_point(center_, corners).point - center_).norm() < 1.5 * radius_;
}

void TracePicture::find_sheet(geom::FacetId from) {
  std::set<geom::FacetId> found{from};
  for (std::vector<geom::FacetId> open{from}; !open.empty();) {
    const geom::FacetId t = open.back();
    open.pop_back();
    for (int e = 0; e < 3; ++e) {
      const geom::FacetId next = mesh_.across(t, e);
      if (next.valid() && in_sight(next) && found.insert(next).second) open.push_back(next);
    }
  }
  sheet_.assign(found.begin(), found.end());
}

bool TracePicture::near(const fpo::CellPolygon& polygon) const {
  return std::ranges::binary_search(sheet_, polygon.facet) &&
         std::ranges::any_of(polygon.corners,
                             [&](const Vec3& p) { return (p - center_).norm() < 1.5 * radius_; });
}

std::vector<fpo::CellPolygon> TracePicture::visible(const geom::RestrictedPower& diagram) const {
  std::vector<fpo::CellPolygon> polygons = fpo::cell_polygons(diagram);
  std::erase_if(polygons, [&](const fpo::CellPolygon& polygon) { return !near(polygon); });
  const auto height = [&](const fpo::CellPolygon& polygon) {
    double sum = 0;
    for (const Vec3& p : polygon.corners) sum += (p - center_).dot(normal_);
    return sum / static_cast<double>(polygon.corners.size());
  };
  std::ranges::stable_sort(polygons, {}, height);
  return polygons;
}

/// In the picture at all, for a point of facet t.
bool TracePicture::is_seen(const Vec3& p, geom::FacetId t) const {
  return std::ranges::binary_search(sheet_, t) && is_framed(project(p));
}

TracePicture::Drawing TracePicture::draw(const geom::RestrictedPower& diagram, geom::SiteId x,
                                         const geom::EmptyCircle* circle, const std::string& title) const {
  io::Svg svg(size, size + caption_height);
  svg.rectangle({0, 0}, {size, size + caption_height}, R"(fill="#fff")");
  std::vector<io::GroupedPolygon> cells;
  std::set<geom::SiteId> sites;
  for (const fpo::CellPolygon& polygon : visible(diagram)) {
    cells.push_back({polygon.site.value, polygon.corners});
    if (holds(polygon, mesh_, diagram.site(polygon.site).position)) sites.insert(polygon.site);
    std::vector<Vec2> corners;
    for (const Vec3& p : polygon.corners) corners.push_back(project(p));
    const std::string fill = polygon.site == x ? "#f4a582" : colour(polygon.site);
    svg.polygon(corners, "fill=\"" + fill + R"(" stroke="#8899aa" stroke-width="0.6")");
  }
  for (const geom::SiteId s : sites) svg.circle(project(diagram.site(s).position), 3, R"(fill="#234")");
  const bool seen = sites.contains(x) && is_framed(project(diagram.site(x).position));
  if (seen) svg.circle(project(diagram.site(x).position), 4.5, R"(fill="#c0392b")");
  const bool circle_seen = circle && circle->radius2 > 0 && is_seen(circle->center, circle->facet);
  if (circle_seen) {
    const double r = std::sqrt(circle->radius2) * size / (2 * radius_);
    svg.circle(project(circle->center), r, R"(fill="none" stroke="#c0392b" stroke-width="1.5")");
    svg.circle(project(circle->center), 2.5, R"(fill="none" stroke="#c0392b")");
  }
  svg.rectangle({0, size}, {size, caption_height}, R"(fill="#fff")");
  const std::string font = R"(font-family="sans-serif" font-size="13" fill="#234")";
  svg.text({10, size + 18}, title, font + R"( font-weight="bold")");
  std::string caption = "Power cells seen from outside";
  caption += seen ? "; red: sample " + std::to_string(x.value)
                  : "; sample " + std::to_string(x.value) + " is out or elsewhere";
  if (circle) caption += circle_seen ? "; circle: the farthest point" : "; the farthest point lies elsewhere";
  svg.text({10, size + 36}, caption, font);
  return {std::move(svg), std::move(cells)};
}

void TracePicture::Drawing::save(const std::filesystem::path& stem) const {
  svg.save(stem.string() + ".svg");
  io::write_polygons(stem.string() + ".obj", "cell_", cells);
}

}  // namespace tools
