#pragma once
// Maps on the remesh: each triangle in the colour of a number.

#include <vector>

#include "geom/mesh/trimesh.h"
#include "io/scene.h"

namespace tools {

/// Blue at the left, red at the right, pale between them.
std::vector<io::Colour> blue_to_red();

/// What a remesh is compared with, and how lengths are told.
struct MapSource {
  const geom::TriMesh& input;
  double unit = 1;  ///< of the input's coordinates in the unit that is shown to people
  int threads = 1;
};

/// The picture of a remesh twice more: its distance from the input (facet_deviations()), pale to red, and the
/// smallest angle of each triangle, red at 30 degrees and less, blue at 60. The picture's triangles must be
/// facets of the mesh in their order; they may be a part of it. Nothing if there are none.
std::vector<io::Scene> remesh_maps(const io::Scene& picture, const geom::TriMesh& mesh,
                                   const MapSource& source);

}  // namespace tools
