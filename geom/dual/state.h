#pragma once
// What the restricted dual is made of: the surface, the sites, and the empty circles that follow from them.
// Its operations (general_removal.h, general_insertion.h, fast_way.h) share it.

#include <limits>
#include <span>
#include <vector>

#include "geom/dual/corner_circles.h"
#include "geom/dual/empty_circles.h"
#include "geom/dual/lead.h"
#include "geom/dual/site_shapes.h"
#include "geom/mesh/facet_tree.h"
#include "geom/power/clip.h"
#include "geom/sites/site_grid.h"
#include "geom/sites/site_tree.h"

namespace geom {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// What one update did. Valid until the next one. An id may be erased and created in the same change: erase
/// first.
struct DualChange {
  std::vector<CircleId> circles_erased, circles_created;
  std::vector<CircleId> circles_moved;  ///< other centers, the same sites
  std::vector<SiteId> cells;            ///< after a removal: those that won something
};

/// Creates these circles in their order. Valid until the next such.
std::span<const CircleId> create_all(std::span<const EmptyCircle> found, EmptyCircles& circles,
                                     DualChange& change);

struct DualState {
  /// Without sites. Keeps a reference to the mesh. Throws InputError if it has no facet. `paper`: if given,
  /// it holds the same sites and names those that can matter to each other; else the tree does. If the mesh
  /// has levels there must be none.
  DualState(const TriMesh& mesh, CornerTypes types, NeighbourOracle* paper);
  DualState(const DualState&) = delete;

  /// Sets the point of a site that is not in.
  void admit(SiteId p, const WeightedPoint3& point);
  // A site that is admitted comes in, goes out, or was elsewhere: for those who search.
  void enter(SiteId p);
  void leave(SiteId p);
  void follow(SiteId p, const Vec3& from);
  /// All sites are in, of about even density or not: chooses how they are searched from now on.
  void choose_search();

  /// Appends all sites that may own a location of the vacancy, and some more (NeighbourOracle::heirs()).
  void near(const Vacancy& vacancy, std::vector<SiteId>& out) const;
  /// Appends all sites that near a location if that is a quick search; else false.
  bool find_near(const Vec3& x, double distance, std::vector<SiteId>& out) const;
  /// NeighbourOracle::nearest().
  NeighbourOracle::Nearest nearest(const Location3& x, SiteId without) const;
  /// The power of a circle's center to the point less that to its sites.
  Sure lead_at(const EmptyCircle& circle, const WeightedPoint3& point) const {
    const WeightedPoint3& owner = sites[circle.sites[0]];
    const double off = 2 * clipper.most_tolerance();
    if (owner.level == point.level) return lead_of(owner, point, circle.center, off);
    const FacetLevels& levels = clipper.levels();
    return lead_of(owner, point, Location3(circle.center, levels.at(circle.facet, circle.center)), off,
                   levels.off(circle.facet, off));
  }
  /// Do the facet and the sites of a circle have this level?
  bool is_level(const EmptyCircle& circle, double level) const;
  /// An upper bound of the distance from the site, of that power.
  double distance_at(double power, SiteId p) const;
  /// The same from any site that has been in.
  double distance_at(double power) const;
  /// Reach of a site: see RestrictedDual::reach_bound().
  void set_reach(SiteId p, double value);
  void raise_reach(SiteId p, double value) {
    if (value > reach[p]) set_reach(p, value);
  }
  /// An upper bound of all weights.
  double heaviest() const { return heaviest_; }
  /// An upper bound of all reaches. Amortised O(1).
  double largest_reach();

  const TriMesh& mesh;
  const bool has_levels;  ///< of the mesh: else all are 0
  const double extent;    ///< bounds all coordinates
  NeighbourOracle* const paper;
  Clipper::Sites sites;
  SiteTree tree;
  SiteGrid grid;  ///< the same sites, where their density is even
  EmptyCircles circles;
  Clipper clipper;
  CornerCircles corners;
  FacetTree facets;
  Table<SiteId, double> reach;  ///< an upper bound of the power in the cell; -infinity: the cell is empty
  Table<SiteId, FacetId> home;  ///< a facet with the location of the site, or none
  std::size_t num_sites = 0;    ///< that are in

  SiteShapes shapes;  ///< of sites that are in; one that goes out is made regular first
  void set_shape(SiteId p, CellShape shape) { shapes.set(p, shape, sites[p].position); }
  /// Appends the sites that are not regular and may lose something to p, and some more.
  void irregular_rivals(SiteId p, std::vector<SiteId>& out);

 private:
  double heaviest_ = 0;
  double largest_reach_ = 0;
  mutable std::vector<SiteId> found_;  // workspace
  std::size_t changes_ = 0;            ///< of reaches, since it was the largest one
};

}  // namespace geom
