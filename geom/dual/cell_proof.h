#pragma once
// Proves what the cell of a site is from its rim: its corners, that nobody beyond the rim comes into it, and
// that the site owns nothing else. On a sheet by the shape of the surface and the places of the sites alone,
// else by tracing the cell (fast_way.h).

#include <span>
#include <vector>

#include "geom/dual/losses.h"
#include "geom/dual/single_component.h"
#include "geom/dual/surroundings.h"

namespace geom {

class CellProof {
 public:
  /// Keeps a reference.
  explicit CellProof(Surroundings& around)
      : around_(around), losses_(around.state, around.sheets), single_(around) {}

  /// A corner of the cell, between rim sites j and j + 1.
  struct Corner {
    FacetId facet;
    SurfacePoint point;
  };
  /// The new place of around.p, which is not in the search there.
  struct Place {
    FacetId home;
    WeightedPoint3 old;     ///< p as its circles have it
    double least_distance;  ///< so far there may be what was not someone else's, and circles that p beats
  };
  /// The cell that p gets there; the rim is known. If true, p is in the paper's oracle.
  bool prove_new(const Place& place);
  bool beats_outer_circle() const;
  /// The cell that p has, from its star.
  bool prove_present();

  /// Of a proven cell: corners by rim places, a bound of the power in it and, on a sheet, on its edges.
  std::span<const Corner> corners() const { return corners_; }
  double reach() const { return reach_; }
  std::span<const double> arcs() const { return arcs_; }

 private:
  bool find_corners();
  bool prove_inserted(const Place& place);
  bool prove_with_leeway(const WeightedPoint3& old);
  bool may_beat_unreached();
  bool keeps_its_place(SiteId s) const;
  double power_bound_at_corners();
  void find_far_rivals(double distance);
  double distance_to_search(double near, const WeightedPoint3& old);
  bool enclose_on_sheet(double distance);
  bool trace(FacetId home);
  bool are_corners_level() const;
  bool has_no_stranger(double radius, bool is_level);

  Surroundings& around_;
  Losses losses_;
  SingleComponent single_;
  std::vector<Corner> corners_;
  double reach_ = 0;
  std::vector<double> arcs_;
  std::vector<double> far2_;  ///< of each corner from p, squared
  double kept_radius_ = 0;    ///< strangers are kept for a ball of that radius
  struct FarRival {
    double distance;  ///< from p: it loses nothing farther away
    SiteId site;
  };
  std::vector<FarRival> far_rivals_;
  // Workspaces.
  std::vector<SiteId> suspects_;
  std::vector<FacetId> facets_;
  std::vector<Sheets::Neighbour> link_;
};

}  // namespace geom
