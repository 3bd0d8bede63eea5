#pragma once
// What the restricted dual is made of: the surface, the sites, and the empty circles that follow from them.
// Its operations (general_removal.h, general_insertion.h, fast_way.h) share it.

#include <limits>
#include <span>
#include <vector>

#include "geom/dual/corner_circles.h"
#include "geom/dual/empty_circles.h"
#include "geom/dual/lead.h"
#include "geom/dual/leeway.h"
#include "geom/dual/reaches.h"
#include "geom/dual/site_search.h"
#include "geom/dual/site_shapes.h"
#include "geom/mesh/facet_tree.h"
#include "geom/power/clip.h"

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
  /// Without sites. Keeps a reference to the surface. Throws InputError if it has no facet. `source`: if
  /// given, it holds the same sites and names those that can matter to each other; else the tree does. If the
  /// surface has levels there must be none.
  DualState(const TriMesh& surface, CornerTypes types, NeighbourOracle* source);
  DualState(const DualState&) = delete;

  /// So many sites are going to be admitted.
  void reserve(std::size_t num_sites);
  /// Sets the point of a site that is not in.
  void admit(SiteId p, const WeightedPoint3& point);
  /// A site comes in, at its point, or goes out.
  void enter(SiteId p);
  void leave(SiteId p);
  /// A site that is in was elsewhere.
  void follow(SiteId p, const Vec3& from);
  /// NeighbourOracle::nearest().
  NeighbourOracle::Nearest nearest(const Location3& x, SiteId without) const;
  /// All sites are in, of about even density or not: chooses how they are searched from now on.
  void choose_search();
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
  /// Is j surely nearer to its own place, which is on the surface but for rounding, than another site? So
  /// much nearer that it is than all others, too, if that one is the nearest of them by rounded powers.
  bool leads_at_its_place(SiteId j, const WeightedPoint3& other) const;
  /// An upper bound of the distance from the site, of that power.
  double distance_at(double power, SiteId p) const;
  /// The same from any site that has been in.
  double distance_at(double power) const;

  const TriMesh& mesh;
  const bool has_levels;  ///< of the mesh: else all are 0
  const double extent;    ///< bounds all coordinates
  NeighbourOracle* const paper;
  Clipper::Sites sites;
  EmptyCircles circles;
  SiteSearch search;  ///< of sites that are in
  Leeways leeways;    ///< where they are of even density and weight
  Reaches reach;
  Clipper clipper;
  CornerCircles corners;
  FacetTree facets;
  Table<SiteId, FacetId> home;  ///< a facet with the location of the site, or none
  SiteShapes shapes;            ///< of sites that are in; one that goes out is made regular first
  void set_shape(SiteId p, CellShape shape) { shapes.set(p, shape, sites[p].position); }
  /// Appends the sites that are not regular and may lose something to p, and some more.
  void irregular_rivals(SiteId p, std::vector<SiteId>& out);
};

}  // namespace geom
