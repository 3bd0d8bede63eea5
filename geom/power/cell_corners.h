#pragma once
// The corners of clipped facets (facet_polygon.h): which sites beat the owner there, decided exactly, and
// where they are, rounded.

#include <array>
#include <cmath>
#include <memory>
#include <span>

#include "geom/ids.h"
#include "geom/mesh/trimesh.h"
#include "geom/power/clip_predicates.h"
#include "geom/power/construct.h"
#include "geom/power/facet_balls.h"
#include "geom/power/facet_polygon.h"

namespace geom {

/// Of the facets of one mesh and the bisectors of one set of sites. Copies share what is known of the facets.
class CellCorners {
 public:
  using Sites = Table<SiteId, WeightedPoint3>;

  /// Keeps references to both. All sites must stay within `extent` of the origin in every coordinate.
  CellCorners(const TriMesh& mesh, const Sites& sites, double extent);

  const FacetBalls& facets() const { return *facets_; }
  const FacetLevels& levels() const { return facets_->levels(); }
  Bisector bisector_of(SiteId owner, SiteId j) const { return bisector(sites_[owner], sites_[j], extent_); }

  /// Both at once, if the three have one level.
  BisectorPair bisectors_of(SiteId owner, SiteId first, SiteId second) const {
    return {sites_[owner], sites_[first], sites_[second], extent_};
  }
  bool have_one_level(const std::array<SiteId, 3>& s) const {
    const double level = sites_[s[0]].level;
    return sites_[s[1]].level == level && sites_[s[2]].level == level;
  }

  /// The whole facet, labelled by its own edges.
  void start(FacetPolygon& polygon, FacetId facet, SiteId owner) const;

  /// Does j beat the owner at this corner of its polygon? Exact. `b` is bisector_of(owner, j).
  bool beats_at(const CellCorner& corner, SiteId j, const Bisector& b) const {
    const auto [f, bound] = value_at(corner.facet, corner.point, b);
    if (f > bound) return false;
    if (f < -bound) return true;
    return beats_exactly(corner, j);
  }
  /// Of the bisector at a location of the facet; at most `off` from that at the exact location.
  struct Value {
    double f, off;
  };
  Value value_at(FacetId facet, const RoundedPoint& point, const Bisector& b) const {
    const double off = b.error + b.length * point.tolerance;
    if (b.rise == 0) return {b(point.position), off};
    return {b(Location3(point.position, levels().at(facet, point.position))),
            off + std::abs(b.rise) * levels().off(facet, point.tolerance)};
  }
  /// beats_at() from the labels alone. Slow.
  bool beats_exactly(const CellCorner& corner, SiteId j) const;
  bool beats_at(const FacetPolygon& polygon, std::size_t k, SiteId j, const Bisector& b) const {
    return beats_at(cell_corner(polygon.facet, polygon.owner, polygon.corners, k), j, b);
  }

  /// The corner where the bisector of owner and j meets what `label` stands for: rounded, a function of the
  /// facet (for a facet edge: of the edge) and of the sites alone, whichever of them is the owner.
  RoundedPoint corner(FacetId facet, EdgeLabel label, SiteId owner, SiteId j, const Bisector& b) const;

  /// The corner of three cells, sites ascending, in a facet: the same bits.
  RoundedPoint meeting(FacetId facet, const std::array<SiteId, 3>& sites) const {
    return meeting(facet, sites,
                   axis_minors(form_on(facet, bisector_of(sites[0], sites[1])),
                               form_on(facet, bisector_of(sites[0], sites[2]))));
  }
  /// Given the minors of these forms.
  RoundedPoint meeting(FacetId facet, const std::array<SiteId, 3>& sites, const AxisMinors& minors) const {
    const auto [v0, v1, v2] = mesh_.facet(facet);
    const RoundedPoint point =
        corner_in_facet(mesh_.position(v0), mesh_.position(v1), mesh_.position(v2), minors, extent_);
    return point.tolerance <= most_tolerance() ? point : exact_meeting(facet, sites);
  }
  /// No corner is farther than this from its rounded place.
  double most_tolerance() const { return 0x1p-32 * extent_; }

  /// The values of a bisector at the corners of a facet.
  LinearForm form_on(FacetId facet, const Bisector& b) const {
    const auto [v0, v1, v2] = mesh_.facet(facet);
    if (b.rise == 0) return {{b(mesh_.position(v0)), b(mesh_.position(v1)), b(mesh_.position(v2))}, b.error};
    return linear_form(b, at(v0), at(v1), at(v2));
  }
  /// The value of a bisector at a vertex.
  double value_at(VertexId v, const Bisector& b) const {
    return b.rise == 0 ? b(mesh_.position(v)) : b(at(v));
  }
  /// The corner of the owner's polygon between edges with these labels: what a clipper computes there.
  RoundedPoint corner_between(FacetId facet, SiteId owner, EdgeLabel before, EdgeLabel after) const;
  /// An upper bound of the power, to the site, of the locations in the polygon.
  double bound_power(FacetId facet, SiteId site, std::span<const PolygonCorner> corners) const;
  double bound_power(const FacetPolygon& polygon) const {
    return bound_power(polygon.facet, polygon.owner, polygon.corners);
  }

 private:
  RoundedPoint exact_meeting(FacetId facet, const std::array<SiteId, 3>& sites) const;
  RankedPoint3 ranked(SiteId s) const { return {&sites_[s], s.value}; }
  Location3 at(VertexId v) const { return {mesh_.position(v), mesh_.level(v)}; }
  FacetCorners corners_of(FacetId t) const {
    const auto [v0, v1, v2] = mesh_.facet(t);
    return {&mesh_.position(v0),
            &mesh_.position(v1),
            &mesh_.position(v2),
            {mesh_.level(v0), mesh_.level(v1), mesh_.level(v2)}};
  }

  const TriMesh& mesh_;
  const Sites& sites_;
  double extent_;
  std::shared_ptr<const FacetBalls> facets_;
};

}  // namespace geom
