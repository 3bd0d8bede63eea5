#pragma once
// Insertion into the triangulation on the torus (Bowyer, Watson): the triangles whose circle the new site
// conflicts with form a cavity, star-shaped about it; the site is joined to the cavity's rim.
//
//      +-------+            +-------+
//     / \     / \          /  \   /  \        cavity: 4 triangles
//    /   \ . /   \        /    \ /    \       rim: 6 corners, counterclockwise
//   +-----+-----+   ->   +------e------+      star: 6 triangles (e, rim[k], rim[k + 1])
//    \   / \   /          \    / \    /
//     \ /   \ /            \  /   \  /
//      +-----+              +-----+

#include <cstdint>
#include <vector>

#include "geom/regular/disk2.h"
#include "geom/regular/triangulation2.h"

namespace geom {

/// One object serves all insertions of a triangulation.
class Insertion2 {
 public:
  /// Makes a site that is stored a vertex, or hides it. `hint`: a triangle nearby, best one in conflict with
  /// it; none for a walk from the last one created. Throws InputError, with nothing modified, if the cavity
  /// is not within half a period of the site.
  void insert(Triangulation2& t, SiteId e, SimplexId hint);

 private:
  void dig_cavity(Triangulation2& t, SiteId e, SimplexId start);
  void require_short_edges(const Triangulation2& t) const;
  void star_cavity(Triangulation2& t, SiteId e);
  void release_corners(Triangulation2& t);
  void settle_displaced(Triangulation2& t);

  std::uint32_t mark_ = 0;  ///< of the triangles of this cavity
  Disk2 cavity_;
  std::vector<Triangulation2::Side> pending_;  ///< sides of the cavity still to be crossed
  std::vector<SiteId> released_;               ///< corners of a cavity, some of which may be swallowed
  std::vector<SiteId> displaced_;              ///< hidden sites whose witness is destroyed
};

}  // namespace geom
