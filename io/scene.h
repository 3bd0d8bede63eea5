#pragma once
// Shaded pictures that a reader can turn: what report_view.js draws, packed into some bytes a triangle.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geom/vec.h"
#include "io/mesh_picture.h"

namespace io {

struct SceneTriangle {
  std::array<std::uint32_t, 3> corners;  ///< places of the scene, counterclockwise seen from outside
  geom::Vec3 normal;                     ///< any length; of the surface, where the triangle is a sliver of it
  std::uint8_t edges = 7;                ///< bit k: the edge from corner k to the next is drawn
  std::uint8_t colour = 0;               ///< of the scene's palette
};

struct SceneDot {
  geom::Vec3 at;
  std::uint8_t colour = 0;
};

/// What colours mean: shown as a bar with the labels below it, evenly spread.
struct SceneScale {
  std::vector<Colour> colours;      ///< from left to right; empty: none is shown
  std::vector<std::string> labels;  ///< two at least
};

/// What a picture shows: everything in a ball that keeps its middle and size while the scene turns.
struct SceneFrame {
  geom::Vec3 center{0, 0, 0};
  double radius = 1;
};

struct Scene {
  std::string title, note;  ///< beneath the picture
  SceneScale scale = {};    ///< beneath that
  SceneFrame frame;
  std::vector<geom::Vec3> places;
  std::vector<SceneTriangle> triangles;
  std::vector<std::array<geom::Vec3, 2>> lines;  ///< features
  std::vector<SceneDot> dots;
  std::vector<Colour> palette{{178, 203, 224}};  ///< at most 256
  bool back_faces = false;  ///< draw triangles seen from behind (surfaces with border), darker
  /// About how far the edges are apart, to leave them out of pictures where they would cover the surface; 0:
  /// their mean length.
  double edge_spacing = 0;
};

/// The directions from which scenes are seen at first (as in MeshPicture).
struct SceneView {
  geom::Vec3 towards_viewer{0.3, 0.25, 1}, up{0, 1, 0};
};

/// A frame that holds all points; a ball about the middle of their box.
SceneFrame frame_of(std::span<const geom::Vec3> points);

/// One JSON object, as report_view.js reads it. Places are rounded to 1/32767 of the frame's radius, normals
/// to about a degree. About 20 bytes a triangle (with one place for two of them).
std::string scene_json(const Scene& scene);

}  // namespace io
