#pragma once
// One look at an input that says what it is.

#include <optional>
#include <string>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "geom/repair/intersections.h"

namespace geom {

struct Diagnosis {
  Topology topology;
  std::vector<double> border_lengths;  ///< of all border loops, descending
  std::size_t holes = 0;               ///< of these, those that --repair would close (repair.h)
  std::size_t split_vertices = 0;      ///< border vertices at the same place as another one
  std::size_t duplicate_facets = 0;    ///< with the same vertices as another, or in parts that lie on another
  std::size_t degenerate_facets = 0;   ///< without area
  std::size_t inverted_facets = 0;     ///< turned otherwise than most of their part
  std::size_t inside_out_parts = 0;    ///< closed, and of negative volume
  std::size_t one_sided_parts = 0;
  std::size_t parts = 0;                       ///< facets joined by edges
  std::size_t stray_facets = 0;                ///< without a neighbour
  std::size_t tiny_parts = 0;                  ///< that --repair would drop (parts.h)
  std::size_t copies = 0;                      ///< parts that lie on another one (copies.h)
  double weld_tolerance = 0;                   ///< that joins most borders, if the usual one does not
  std::size_t spikes = 0;                      ///< vertices far out of the surface (spikes.h)
  std::optional<Intersections> intersections;  ///< if they were asked for
};

/// O(F log F), and what copies.h says.
Diagnosis diagnosis(const TriMesh& mesh, bool with_intersections);

/// What of it makes a remesh other than the user expects; empty if nothing does: "3 non-manifold edges, 1
/// crumb". One line.
std::string in_words(const Diagnosis& found);

}  // namespace geom
