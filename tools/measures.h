#pragma once
// What fpo-quality prints of a mesh, for all tools that show it.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fpo/measure/covering.h"
#include "fpo/measure/hausdorff.h"
#include "fpo/measure/quality.h"
#include "geom/mesh/trimesh.h"

namespace tools {

struct Measures {
  geom::Topology topology;
  fpo::Quality quality;
  bool compared = false;          ///< with a reference
  fpo::SurfaceDistance distance;  ///< in percent of the reference's diagonal
  /// Of the reference by the mesh's vertices, each with its distance to the nearest other as its size.
  fpo::Covering covering;
};

/// The mesh by itself.
Measures measure(const geom::TriMesh& mesh);
/// The mesh, its distance to the surface that it approximates, whose area gives the unit of delta, and how
/// its vertices cover that. `tell` is called now and then with the share that is done. Throws
/// geom::InputError if the reference has no area.
Measures measure(const geom::TriMesh& mesh, const geom::TriMesh& reference, int threads,
                 const std::function<void(double)>& tell = {});

/// Their names, as fpo-quality prints them, and values.
std::vector<std::pair<std::string, double>> named(const Measures& measures);
/// "name": value for each, in braces.
std::string json(const std::vector<std::pair<std::string, double>>& values);

}  // namespace tools
