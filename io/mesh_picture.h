#pragma once
// Pictures of meshes: orthographic, flat shaded, drawn from back to front.

#include <cstdint>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "io/svg.h"

namespace io {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// "#rrggbb".
std::string css(Colour colour);

struct MeshPicture {
  geom::Vec3 towards_viewer{0.3, 0.25, 1};  ///< any length
  geom::Vec3 up{0, 1, 0};                   ///< shown upwards; not parallel to towards_viewer
  double size = 640;                        ///< the picture's longer side, pixels
  double edge_width = 0.5;                  ///< pixels; 0: no edges
  bool back_faces = false;                  ///< draw facets seen from behind (surfaces with border), darker
  Colour surface{178, 203, 224};
  std::vector<Colour> facet_colours;  ///< one per facet instead of `surface`, or empty
  std::vector<geom::Vec3> points;     ///< drawn as dots where the surface does not hide them
  double point_radius = 2;            ///< pixels
  Colour point_colour{196, 48, 43};
};

/// Facets are sorted by the depth of their centroids (painter's algorithm: right for surfaces of small
/// facets); facets of one shade that follow each other share a path. About 30 bytes a visible facet. Throws
/// geom::InputError if the directions span no plane or facet_colours does not match the mesh. Cost: O(F log
/// F).
Svg draw_mesh(const geom::TriMesh& mesh, const MeshPicture& picture = {});

}  // namespace io
