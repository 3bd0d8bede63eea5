#pragma once
// Where the restricted power diagram learns which sites can matter to each other. Two answers, one interface:
// the link in the dynamic regular triangulation (the paper's way, triangulation_oracle.h) and a certified
// spatial search (site_tree.h). Both name supersets of the sites that do matter; the clipper decides exactly,
// so both lead to the same diagram.
//
// Heirs: the sites that own what a removed site owned, its natural neighbours. Rivals: the sites that lose
// something to a new one, those in conflict with it.

#include <vector>

#include "geom/ids.h"
#include "geom/vec.h"

namespace geom {

/// A bound on where a removed cell was and how far from any site its locations are now.
struct Vacancy {
  SiteId site;         ///< the removed one
  Vec3 center;         ///< its position
  double radius;       ///< every location of its cell is at most this far from the center
  double max_radius2;  ///< and has at most this power to the nearest remaining site
};

/// Who is near, among sites that may stay as they are.
class NearSites {
 public:
  virtual ~NearSites() = default;

  /// Appends every site that may own a part of the cell of the site that was just removed.
  virtual void heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const = 0;

  /// The site nearest to the location x in power, `without` left out, to the bit what trying all sites gives:
  /// of those with the same rounded power the one of smallest id.
  struct Nearest {
    SiteId site;     ///< none if there is no other site
    double radius2;  ///< power(x, site); +infinity if none
  };
  /// `hint`: a site nearby (it may be `without` if that is present), or none.
  virtual Nearest nearest(const Location3& x, SiteId without, SiteId hint) const = 0;
};

/// The same of sites that come and go.
class NeighbourOracle : public NearSites {
 public:
  /// `hint`: a site nearby, or none.
  virtual void insert(SiteId id, const WeightedPoint3& point, SiteId hint) = 0;
  virtual void remove(SiteId id) = 0;

  /// Appends every site (but p) of which the cell may lose something to p, which was just inserted.
  virtual void rivals(SiteId p, std::vector<SiteId>& out) const = 0;

  /// The largest power of a location in the cell of j to j; -infinity if the cell is empty. To be said after
  /// each change of the cell and before the next rivals().
  virtual void set_reach(SiteId j, double max_radius2) = 0;
};

}  // namespace geom
