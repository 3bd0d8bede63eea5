#pragma once
// Removal from the triangulation on the torus: the star of the site becomes a hole, which is filled as
// planned (hole_plan2.h).

#include <vector>

#include "geom/regular/disk2.h"
#include "geom/regular/hole_plan2.h"
#include "geom/regular/insertion2.h"

namespace geom {

/// One object serves all removals of a triangulation.
class Removal2 {
 public:
  /// Removes a site, which is visible or hidden. `insertion`: for those who come to light. Throws InputError,
  /// with nothing modified, if an edge would be half a period or longer.
  void remove(Triangulation2& t, SiteId id, Insertion2& insertion);

 private:
  void open_hole(const Triangulation2& t, SiteId p);
  void require_short_chords(const Triangulation2& t) const;
  void fill_hole(Triangulation2& t, SiteId p);
  void expose_orphans(Triangulation2& t, Insertion2& insertion);

  Disk2 hole_;
  HolePlan2 plan_;
  std::vector<Triangulation2::Side> closing_;  ///< of each chain of the plan its triangle's side on the chord
  std::vector<SiteId> orphans_;                ///< sites that were hidden in the hole, so perhaps exposed
};

}  // namespace geom
