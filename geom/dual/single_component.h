#pragma once
// Has a site no second component? By the shape of the surface (sheets.h), or else by looking at each facet
// near it that the cell which was traced does not meet.

#include <vector>

#include "geom/dual/surroundings.h"

namespace geom {

class SingleComponent {
 public:
  /// Keeps a reference.
  explicit SingleComponent(Surroundings& around) : around_(around) {}

  /// Has the cell of p that was traced (around.flood), with at most that power, all that p owns within that
  /// distance? p is the frame's origin. False: not certain.
  bool is_all(double cell_reach, double distance);

 private:
  bool is_beaten_by_rim(const Frame::Place& center, double radius) const;
  bool is_beaten_by_rival(const Frame::Place& center, double radius);
  bool owns_nothing_of(FacetId t);
  void find_rivals(double distance);
  bool keep_part(const Frame::Seen& site, double size);

  /// A site from p.
  struct Rival {
    Frame::Seen seen;
    double length, slack;
  };

  Surroundings& around_;
  // Workspaces.
  std::vector<Frame::Place> part_, clipped_;
  std::vector<double> values_;
  std::vector<SiteId> found_;
  std::vector<Rival> rivals_;  ///< empty: not looked for
  std::vector<FacetId> facets_;
  std::vector<Sheets::Neighbour> link_;
};

}  // namespace geom
