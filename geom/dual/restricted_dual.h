#pragma once
// The restricted dual of a surface's power diagram under insertion and removal of sites (paper, section 4.2):
// its empty circles and who lies beside whom, without the polygons of the diagram.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geom/dual/fast_way.h"
#include "geom/dual/redivision.h"
#include "geom/dual/state.h"

namespace geom {

/// Exact: after each update the circles are those of the diagram of the present sites built from nothing.
class RestrictedDual {
 public:
  using Change = DualChange;

  /// Empty. Keeps references. `paper`: if given, it is filled with the same sites and names those that can
  /// matter to each other (the paper's regular triangulation); else a search does. Throws InputError if the
  /// mesh has no facet.
  RestrictedDual(const TriMesh& mesh, CornerTypes types, NeighbourOracle* paper = nullptr);

  /// Sites 0, 1, ... at once, there being none. `order`: in which they enter the search; it and the number of
  /// threads do not matter to the result. Cost: the facets and the fragments, times the logarithm of the
  /// number of sites. `homes`: for each site a facet that it was rounded from.
  /// `known`: of each site's cell here, or empty.
  const Change& build(std::span<const WeightedPoint3> points, std::span<const FacetId> homes,
                      std::span<const SiteId> order, int threads, std::span<const KnownCell> known = {});
  /// `home`: a facet that the point was rounded from, or none (then the general way is taken). `at`: a circle
  /// that p beats, or none: then it is looked for.
  const Change& insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at = CircleId());
  const Change& remove(SiteId p);

  // A removal and an insertion in one, for a site that mostly comes back nearby. First the removal is only
  // planned; then stay() or move() follows.
  struct Plan {
    std::span<const SiteId> heirs;         ///< that win something
    std::span<const EmptyCircle> circles;  ///< that the hole would have
    double reach;                          ///< an upper bound of the power in p's cell
    double max_radius2;                    ///< the same without p
  };
  /// None if p has no cell, or all of its surface alone, or with CornerTypes::all: then remove() is the way.
  std::optional<Plan> plan_removal(SiteId p);
  /// The same plan with the least bounds. Cost: the facets around p.
  Plan plan_exactly(SiteId p);
  const Change& stay(SiteId p);
  /// To the center of a circle: a planned one by its place among Plan::circles, or any other that does not
  /// touch p.
  struct Target {
    std::size_t planned = 0;
    CircleId circle;  ///< none: the planned one
  };
  const Change& move(SiteId p, const WeightedPoint3& point, FacetId home, Target target);

  /// p is going to be removed, so many calls later: asks the memory for a part of what that reads. No effect
  /// but on speed.
  void expect(SiteId p, int calls) const;

  const TriMesh& mesh() const { return state_.mesh; }
  std::size_t num_sites() const { return state_.num_sites; }
  const WeightedPoint3& site(SiteId p) const { return state_.sites[p]; }
  const EmptyCircle& circle(CircleId c) const { return state_.circles[c]; }
  /// The circles that touch p: the corners of its cell. Valid until the next update.
  std::span<const CircleId> circles_of(SiteId p) const { return state_.circles.of_site(p); }
  /// The sites that share a circle with p, ascending: with type C corners the link of p in the dual, the
  /// restricted regular triangulation.
  void link(SiteId p, std::vector<SiteId>& out) const;
  /// Does p own anything?
  bool has_cell(SiteId p) const { return state_.reach[p] > -std::numeric_limits<double>::infinity(); }

  /// For another diagram in which the cell of p is the same, and so is the surface around it.
  KnownCell known_cell(SiteId p) const { return fast_.known(p); }
  /// An upper bound of the power of the locations in p's cell; -infinity if that is empty.
  double reach_bound(SiteId p) const { return state_.reach[p]; }
  /// The least such bound, which then is reach_bound() too. Cost: the facets around p.
  double reach(SiteId p);
  /// The polygons of p's cell, ascending by facet. Cost: the facets around p.
  std::vector<FacetPolygon> cell(SiteId p);
  /// The site nearest to x in power, as NeighbourOracle::nearest().
  NeighbourOracle::Nearest nearest(const Location3& x, SiteId without) const {
    return state_.nearest(x, without);
  }
  /// Of a location of the facet; what a site there has, too.
  double level_at(FacetId t, const Vec3& x) const { return state_.clipper.levels().at(t, x); }
  /// All sites that are in, by position.
  const SiteTree& tree() const { return state_.tree; }

  /// How often which way was taken.
  struct Ways {
    std::size_t in_place = 0, fast_removals = 0, fast_insertions = 0, general_removals = 0,
                general_insertions = 0;
  };
  const Ways& ways() const { return ways_; }
  /// Sites whose cells are not known to be connected, with one border through all their circles (fast_way.h).
  std::size_t num_irregular() const { return state_.shapes.not_regular().size(); }

  /// Verifies lists and bounds; throws Bug. O(circles).
  void check() const;

 private:
  void begin();
  void insert_anyhow(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at);
  void remove_generally(SiteId p);
  Plan general_plan() const;
  void forget_shapes();
  CircleId beaten_circle(const WeightedPoint3& point) const;
  void take_net_change();

  DualState state_;
  FastWay fast_;
  Redivision redivision_;
  Change change_;
  Ways ways_;
  bool is_general_ = false;         ///< the plan
  std::vector<CircleId> unlisted_;  ///< created and erased in the same change
};

}  // namespace geom
