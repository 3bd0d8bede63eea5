#pragma once
// The pictures of a report: input, samples, power diagram, remesh, and maps of its flaws.

#include <vector>

#include "fpo/remesh/pipeline.h"
#include "io/scene.h"

namespace tools {

/// What a remesh was made of, and what came out.
struct RemeshPictures {
  const geom::TriMesh& input;
  const fpo::RemeshOptions& options;
  const fpo::RemeshResult& result;         ///< with its cells (RemeshOptions::keep_cells)
  const fpo::VertexField& wanted_lengths;  ///< result.sizing in the units that are shown to people
  double unit = 1;                         ///< of the coordinates in those units
};

/// Sizes beyond which pictures show a simplified input, and of samples, cells and remesh a part. They keep a
/// report below some 10 MB.
struct SceneLimits {
  std::size_t input_facets = 120'000;
  std::size_t samples = 40'000;        ///< more: as many of them around the one nearest to the viewer
  std::size_t cell_corners = 700'000;  ///< of the power diagram's polygons; more: a part with about so many
};

/// The four scenes and the maps (report_maps.h), in frames that they share as far as they show the same part.
/// Coordinates should be of moderate size (geom::factor_to_unit_box). O(size log size).
std::vector<io::Scene> remesh_scenes(const RemeshPictures& of, const io::SceneView& view,
                                     const SceneLimits& limits = {});

}  // namespace tools
