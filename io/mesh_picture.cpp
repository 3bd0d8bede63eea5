#include "io/mesh_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "geom/check.h"

namespace io {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec2;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double units_per_pixel = 4;  // paths use whole numbers of quarter pixels
constexpr int shades = 24;

/// The viewer's frame: x to the right, y down, depth towards the viewer; x and y fill the picture.
class Camera {
 public:
  Camera(const TriMesh& mesh, const MeshPicture& picture) {
    const Vec3 toward = picture.towards_viewer.normalized();
    const Vec3 right = picture.up.cross(toward);
    geom::require(right.norm() > 1e-6 * picture.up.norm(), "the view direction and 'up' must span a plane");
    axes_.row(0) = right.normalized();
    axes_.row(1) = -toward.cross(right).normalized();
    axes_.row(2) = toward;
    Eigen::AlignedBox2d box;
    for (const auto& facet : mesh.facets())
      for (const VertexId v : facet) box.extend((axes_ * mesh.position(v)).head<2>());
    for (const Vec3& p : picture.points) box.extend((axes_ * p).head<2>());
    geom::require(!box.isEmpty(), "nothing to draw");
    const double longest = box.sizes().maxCoeff();
    const double margin = 4;
    scale_ = longest > 0 ? (picture.size - 2 * margin) / longest : 1;
    pixels_ = scale_ * box.sizes() + Vec2::Constant(2 * margin);
    origin_ = box.min() - Vec2::Constant(margin / scale_);
  }

  Vec2 pixels() const { return pixels_; }
  Vec2 project(const Vec3& p) const { return units_per_pixel * scale_ * ((axes_ * p).head<2>() - origin_); }
  double depth(const Vec3& p) const { return axes_.row(2).dot(p); }
  Vec3 turn(const Vec3& direction) const { return axes_ * direction; }

 private:
  Eigen::Matrix3d axes_;
  double scale_;
  Vec2 origin_, pixels_;
};

/// Soft light from the upper left, behind the viewer's shoulder: 0 in full shadow, 1 fully lit. `normal` in
/// the viewer's frame.
double light(const Vec3& normal) {
  const Vec3 towards_light = Vec3(-0.45, -0.65, 0.75).normalized();
  return 0.5 + 0.5 * normal.normalized().dot(towards_light);
}

/// From a cool, darker tone in the shadow to a tone lighter than the colour itself.
Colour shaded(Colour colour, int shade) {
  const double t = static_cast<double>(shade) / (shades - 1);
  const auto mix = [t](std::uint8_t base, double shadow) {
    const double lit = base + 0.55 * (255 - base);
    const double value = (1 - t) * shadow * base + t * lit;
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {mix(colour.red, 0.30), mix(colour.green, 0.33), mix(colour.blue, 0.42)};
}

/// One thing to draw: a facet, or an overlaid point.
struct Item {
  double depth;
  int rank;  ///< ties: facets by id, then points by their place in the list
  Colour colour;
  FacetId facet;      ///< none: a point
  std::size_t point;  ///< index in the picture's list
};

std::vector<Item> collect(const TriMesh& mesh, const MeshPicture& picture, const Camera& camera) {
  std::vector<Item> items;
  double lengths = 0;
  for (std::size_t i = 0; i < mesh.num_facets(); ++i) {
    const FacetId t(i);
    lengths += (mesh.corner(t, 1) - mesh.corner(t, 0)).norm();
    Vec3 normal = camera.turn(mesh.normal(t));
    if (normal.z() == 0 || (normal.z() < 0 && !picture.back_faces)) continue;
    const bool behind = normal.z() < 0;
    if (behind) normal = -normal;
    const double brightness = behind ? 0.45 * light(normal) : light(normal);
    const int shade = static_cast<int>(std::lround(brightness * (shades - 1)));
    const Colour base = picture.facet_colours.empty() ? picture.surface : picture.facet_colours[i];
    const Vec3 centroid = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
    items.push_back({camera.depth(centroid), static_cast<int>(i), shaded(base, shade), t, 0});
  }
  // A point lies on the surface, among facets of about its depth: bring it one edge length nearer than those.
  const double lift = mesh.num_facets() == 0 ? 0 : lengths / static_cast<double>(mesh.num_facets());
  for (std::size_t i = 0; i < picture.points.size(); ++i)
    items.push_back({camera.depth(picture.points[i]) + lift, static_cast<int>(mesh.num_facets() + i),
                     picture.point_colour, FacetId(), i});
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return std::tie(a.depth, a.rank) < std::tie(b.depth, b.rank);
  });
  return items;
}

/// Names of (colour, facet or point) pairs; each becomes one CSS rule. A name tells its rule: pictures on one
/// page share their rules.
class Classes {
 public:
  explicit Classes(const MeshPicture& picture) : picture_(picture) {}

  std::string name_of(const Item& item) {
    const bool point = !item.facet.valid();
    const std::string colour = css(item.colour);
    const std::string kind = point                     ? "p" + width(2 * picture_.point_radius) + "-"
                             : picture_.edge_width > 0 ? "f"
                                                       : "s";
    const std::string name = kind + colour.substr(1);
    if (names_.insert(name).second) rules_ += "." + name + "{" + declarations(point, colour) + "}\n";
    return name;
  }
  const std::string& rules() const { return rules_; }

 private:
  /// Without edges a facet's outline has its own colour, which hides the seams between facets.
  std::string declarations(bool point, const std::string& colour) const {
    if (point) return "stroke:" + colour + ";stroke-width:" + width(2 * picture_.point_radius);
    return "fill:" + colour + (picture_.edge_width > 0 ? "" : ";stroke:" + colour);
  }
  static std::string width(double pixels) { return std::to_string(std::lround(pixels * units_per_pixel)); }

  const MeshPicture& picture_;
  std::set<std::string> names_;
  std::string rules_;
};

void append(SvgPath& path, const Item& item, const TriMesh& mesh, const MeshPicture& picture,
            const Camera& camera) {
  if (!item.facet.valid()) {
    path.dot(camera.project(picture.points[item.point]));
    return;
  }
  std::array<Vec2, 3> corners;
  for (int k = 0; k < 3; ++k)
    corners[static_cast<std::size_t>(k)] = camera.project(mesh.corner(item.facet, k));
  path.polygon(corners);
}

/// The group's attributes: units, edges, round joins and caps.
std::string group_attributes(const MeshPicture& picture) {
  const double width = picture.edge_width > 0 ? picture.edge_width : 0.4;
  std::string attributes = "transform=\"scale(.25)\" stroke=\"#2b3440\" stroke-width=\"";
  attributes += std::to_string(std::max(1L, std::lround(width * units_per_pixel)));
  return attributes + "\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
}

}  // namespace

std::string css(Colour colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned channel : {colour.red, colour.green, colour.blue}) {
    text += digits[channel / 16];
    text += digits[channel % 16];
  }
  return text;
}

Svg draw_mesh(const TriMesh& mesh, const MeshPicture& picture) {
  geom::require(picture.facet_colours.empty() || picture.facet_colours.size() == mesh.num_facets(),
                "a picture needs one colour per facet");
  const Camera camera(mesh, picture);
  const std::vector<Item> items = collect(mesh, picture, camera);
  Classes classes(picture);
  for (const Item& item : items) classes.name_of(item);

  Svg svg(std::ceil(camera.pixels().x()), std::ceil(camera.pixels().y()));
  svg.style(classes.rules());
  svg.begin_group(group_attributes(picture));
  for (std::size_t i = 0; i < items.size();) {
    const std::string name = classes.name_of(items[i]);
    SvgPath path(0);
    for (; i < items.size() && classes.name_of(items[i]) == name; ++i)
      append(path, items[i], mesh, picture, camera);
    svg.path(path, "class=\"" + name + "\"");
  }
  svg.end_group();
  return svg;
}

}  // namespace io
