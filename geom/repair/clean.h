#pragma once
// What is done to every input: faults that files have and surfaces have not are mended, and no point moves by
// more than its coordinates are rounded.

#include <string>

#include "geom/mesh/trimesh.h"

namespace geom {

struct Cleaning {
  std::size_t welded = 0;    ///< pairs of border edges that coincided
  std::size_t repeated = 0;  ///< facets with the same vertices as another
  std::size_t doubled = 0;   ///< facets of parts that lie on another part
  std::size_t flat = 0;      ///< facets without area that were removed, or flipped with a neighbour
  std::size_t hanging = 0;   ///< crumbs that hang on vertices (parts.h)
  std::size_t crowded = 0;   ///< border edges left, for more than two coincide

  bool any() const { return welded + repeated + doubled + flat + hanging > 0; }
};

/// "welded 12 pairs of border edges, dropped 3 repeated facets"; empty if nothing was done.
std::string in_words(const Cleaning& done);

struct Cleaned {
  TriMesh mesh;
  Cleaning done;
};

/// Facets that are repeated, doubled or without area go, and crumbs that hang on vertices; border edges whose
/// ends have equal coordinates, exactly or but for rounding (weld.h), are welded where two coincide, not
/// more. The vertices stay as they are, with their ids, though some may be left without a facet. A mesh
/// without such faults comes back as it is; so does one of which nothing would be left, or whose coordinates
/// are beyond what scaling.h takes. O(F log F).
Cleaned cleaned(const TriMesh& mesh);

}  // namespace geom
