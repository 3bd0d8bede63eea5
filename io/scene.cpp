#include "io/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "io/numbers.h"
#include "io/png.h"

namespace io {

using geom::Vec3;

namespace {

/// Bytes that the script's readers understand.
class Packed {
 public:
  void byte(unsigned value) { bytes_ += static_cast<char>(value & 255U); }
  /// 7 bits a byte, least first; the top bit says that more follow.
  void number(std::uint32_t value) {
    for (; value >= 128; value >>= 7) byte((value & 127U) | 128U);
    byte(value);
  }
  void place(const Vec3& p, const SceneFrame& frame) {
    for (int k = 0; k < 3; ++k) {
      const double x = std::clamp((p[k] - frame.center[k]) / frame.radius, -1.0, 1.0);
      const auto steps = static_cast<unsigned>(std::lround((x + 1) * 32767.5));
      byte(steps), byte(steps >> 8);
    }
  }
  /// The octahedron |x| + |y| + |z| = 1 unfolded onto a square.
  void direction(const Vec3& normal) {
    const double sum = normal.cwiseAbs().sum();
    Vec3 n = sum > 0 ? Vec3(normal / sum) : Vec3(0, 0, 1);
    if (n.z() < 0)
      n = {std::copysign(1 - std::abs(n.y()), n.x()), std::copysign(1 - std::abs(n.x()), n.y()), n.z()};
    for (int k = 0; k < 2; ++k) byte(static_cast<unsigned>(std::lround((n[k] + 1) * 127)));
  }
  std::string text() const { return base64(bytes_); }

 private:
  std::string bytes_;
};

/// Collects the fields of a JSON object.
class Json {
 public:
  void field(const char* name, const std::string& value) {
    text_ += text_.empty() ? "{\"" : ",\"";
    ((text_ += name) += "\":") += value;
  }
  void field(const char* name, const Packed& bytes) { field(name, "\"" + bytes.text() + "\""); }
  std::string text() const { return text_ + "}"; }

 private:
  std::string text_;
};

/// Places in the order in which the triangles first name them; those that none names are left out.
struct Order {
  std::vector<std::uint32_t> number_of;  ///< of each place; none: it is not there
  std::vector<std::uint32_t> places;
};

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Each corner as the distance below the smallest number that has not occurred yet: mostly one byte.
Packed packed_corners(const Scene& scene, Order& order) {
  order.number_of.assign(scene.places.size(), none);
  Packed corners;
  for (const SceneTriangle& t : scene.triangles) {
    for (const std::uint32_t place : t.corners) {
      geom::ensure(place < scene.places.size(), "a scene's triangle names a place that is not there");
      const auto fresh = static_cast<std::uint32_t>(order.places.size());
      std::uint32_t& number = order.number_of[place];
      if (number == none) number = fresh, order.places.push_back(place);
      corners.number(fresh - number);
    }
  }
  return corners;
}

double mean_edge_length(const Scene& scene) {
  double sum = 0;
  for (const SceneTriangle& t : scene.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += (scene.places[t.corners[k]] - scene.places[t.corners[(k + 1) % 3]]).norm();
  return sum / std::max(1.0, 3 * static_cast<double>(scene.triangles.size()));
}

void add_triangles(Json& json, const Scene& scene) {
  Order order;
  const Packed corners = packed_corners(scene, order);
  Packed places, normals, edges, colours;
  for (const std::uint32_t place : order.places) places.place(scene.places[place], scene.frame);
  for (const SceneTriangle& t : scene.triangles) {
    normals.direction(t.normal);
    edges.byte(t.edges);
    colours.byte(t.colour);
  }
  json.field("triangles", std::to_string(scene.triangles.size()));
  json.field("places", places);
  json.field("corners", corners);
  json.field("normals", normals);
  if (std::ranges::any_of(scene.triangles, [](const SceneTriangle& t) { return t.edges != 7; }))
    json.field("edges", edges);
  if (std::ranges::any_of(scene.triangles, [](const SceneTriangle& t) { return t.colour != 0; }))
    json.field("colours", colours);
}

void add_overlays(Json& json, const Scene& scene) {
  Packed lines, dots, colours;
  for (const auto& line : scene.lines)
    for (const Vec3& end : line) lines.place(end, scene.frame);
  for (const SceneDot& dot : scene.dots) {
    dots.place(dot.at, scene.frame);
    colours.byte(dot.colour);
  }
  if (!scene.lines.empty()) json.field("lines", lines);
  if (scene.dots.empty()) return;
  json.field("dots", dots);
  json.field("dotColours", colours);
}

}  // namespace

SceneFrame frame_of(std::span<const Vec3> points) {
  geom::Box3 box;
  for (const Vec3& p : points) box.extend(p);
  SceneFrame frame;
  if (box.isEmpty()) return frame;
  frame.center = box.center();
  frame.radius = 0;
  for (const Vec3& p : points) frame.radius = std::max(frame.radius, (p - frame.center).norm());
  if (!(frame.radius > 0)) frame.radius = 1;
  return frame;
}

std::string scene_json(const Scene& scene) {
  Json json;
  add_triangles(json, scene);
  add_overlays(json, scene);
  std::string palette;
  for (const Colour colour : scene.palette) palette += (palette.empty() ? "[\"" : ",\"") + css(colour) + "\"";
  json.field("palette", palette + "]");
  json.field("backFaces", scene.back_faces ? "true" : "false");
  const double spacing = scene.edge_spacing > 0 ? scene.edge_spacing : mean_edge_length(scene);
  std::string length;
  append_shortest(length, spacing / scene.frame.radius);
  json.field("edgeLength", length);
  return json.text();
}

}  // namespace io
