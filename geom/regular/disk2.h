#pragma once
// Some triangles of the torus that are to be replaced, and what is around them.

#include <vector>

#include "geom/regular/triangulation2.h"

namespace geom {

/// Together a disk.
struct Disk2 {
  std::vector<SimplexId> triangles;
  std::vector<SeenSite> rim;                 ///< its corners, counterclockwise, as seen from a site within
  std::vector<Triangulation2::Side> beyond;  ///< sides outside: beyond[k] on the edge from rim[k] to the next

  void clear() {
    triangles.clear();
    rim.clear();
    beyond.clear();
  }
  std::size_t next(std::size_t k) const { return k + 1 < rim.size() ? k + 1 : 0; }

  /// Destroys the triangles. `displaced`: the hidden sites that have no witness since.
  void destroy(Triangulation2& t, std::vector<SiteId>& displaced) const;
};

// A hidden site gets a witness, or is taken from its own.
void hide(Triangulation2& t, SiteId id, SimplexId witness);
void unhide(Triangulation2& t, SiteId id);

}  // namespace geom
