#pragma once
// The restricted dual of a surface's power diagram under insertion and removal of sites (paper, section 4.2):
// its empty circles and who lies beside whom, without the polygons of the diagram.

#include <optional>
#include <span>
#include <vector>

#include "geom/dual/dual_updates.h"
#include "geom/dual/planned_removal.h"
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
  /// `known`: of the diagram here, if anything is; what is known of cells need not be found out.
  const Change& build(std::vector<WeightedPoint3> points, std::span<const FacetId> homes,
                      std::span<const SiteId> order, int threads, const KnownDiagram& known = {}) {
    return updates_.build(std::move(points), homes, order, threads, known);
  }
  /// `home`: a facet that the point was rounded from, or none (then the general way is taken). `at`: a circle
  /// that p beats, or none: then it is looked for.
  const Change& insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at = CircleId()) {
    return updates_.insert(p, point, home, at);
  }
  const Change& remove(SiteId p) { return updates_.remove(p); }
  /// A removal that is not carried out yet, or none if it must be (planned_removal.h).
  std::optional<PlannedRemoval> plan_removal(SiteId p) { return PlannedRemoval::of(p, updates_); }

  /// p is going to be removed, so many calls later: asks the memory for a part of what that reads. No effect
  /// but on speed.
  void expect(SiteId p, int calls) const;

  const TriMesh& mesh() const { return state_.mesh; }
  std::size_t num_sites() const { return state_.search.size(); }
  const WeightedPoint3& site(SiteId p) const { return state_.sites[p]; }
  /// Those that are in; one that is out is where it was.
  const Clipper::Sites& sites() const { return state_.sites; }
  const EmptyCircle& circle(CircleId c) const { return state_.circles[c]; }
  /// The circles that touch p: the corners of its cell. Valid until the next update.
  std::span<const CircleId> circles_of(SiteId p) const { return state_.circles.of_site(p); }
  /// All circles, each once, those of a smaller first site first. O(circles).
  std::vector<CircleId> circles() const;
  /// The sites that share a circle with p, ascending: with type C corners the link of p in the dual, the
  /// restricted regular triangulation.
  void link(SiteId p, std::vector<SiteId>& out) const;
  /// Does p own anything?
  bool has_cell(SiteId p) const { return state_.reach[p] > Reaches::of_nothing; }

  /// Gives back memory for what can be found out again. No effect but on speed.
  void shrink() { updates_.shrink(); }
  /// Finds out what known_cell() and num_irregular() tell, if nobody has: after a build without `known` the
  /// first update does. Cost: as that of the build.
  void certify() { updates_.certify_all(); }
  /// For another diagram in which the cell of p is the same, and so is the surface around it. Nothing if
  /// nobody has found out.
  KnownCell known_cell(SiteId p) const { return updates_.known_cell(p); }
  /// An upper bound of the power of the locations in p's cell; -infinity if that is empty.
  double reach_bound(SiteId p) const { return state_.reach[p]; }
  /// A lower bound of what reach() gives, from the circles. Cost: those of p.
  double least_reach(SiteId p) const;
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
  const SiteTree& tree() const { return state_.search.tree(); }

  const DualWays& ways() const { return updates_.ways(); }
  /// Sites whose cells are not known to be connected, with one border through all their circles (fast_way.h).
  std::size_t num_irregular() const { return state_.shapes.not_regular().size(); }

  /// Verifies lists and bounds; throws Bug. O(circles).
  void check() const;

 private:
  DualState state_;
  Redivision redivision_;
  DualUpdates updates_;
};

}  // namespace geom
