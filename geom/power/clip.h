#pragma once
// A facet of the surface clipped to one power cell: a convex polygon whose edges are labelled, decided
// exactly.
//
//            k (site)             The polygon is known by its labels alone: each edge lies on an edge of
//          o---------o            the facet or on the bisector of the owner with a site. A corner is the
//         /   owner   \  j        meeting of two labels (paper, section 4.1):
//        o-------------o            type A  facet edge, facet edge   a vertex of the surface
//          facet edge               type B  facet edge, site         an edge of the surface and a bisector
//                                   type C  site, site               an edge of the power diagram
//
// Positions are rounded and carry their error bound; they serve as filter, never as the judge.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "geom/ids.h"
#include "geom/mesh/levels.h"
#include "geom/mesh/trimesh.h"
#include "geom/power/clip_predicates.h"
#include "geom/power/construct.h"

namespace geom {

/// What an edge of a clipped facet lies on.
class EdgeLabel {
 public:
  constexpr EdgeLabel() = default;
  static constexpr EdgeLabel bisector(SiteId j) { return EdgeLabel(j.value); }
  static constexpr EdgeLabel facet_edge(int e) { return EdgeLabel(-1 - e); }
  constexpr bool is_site() const { return code_ >= 0; }
  constexpr SiteId site() const { return SiteId(code_); }
  constexpr int edge() const { return -1 - code_; }
  constexpr auto operator<=>(const EdgeLabel&) const = default;

 private:
  constexpr explicit EdgeLabel(std::int32_t code) : code_(code) {}
  std::int32_t code_ = 0;
};

/// A corner and the edge that starts there, counterclockwise.
struct PolygonCorner {
  RoundedPoint point;
  EdgeLabel edge;
};

/// The corners of a polygon of n corners are in a cycle.
inline std::size_t next_corner(std::size_t k, std::size_t n) { return k + 1 == n ? 0 : k + 1; }
inline std::size_t previous_corner(std::size_t k, std::size_t n) { return k == 0 ? n - 1 : k - 1; }

/// A clipped facet under work. No corners: empty.
struct FacetPolygon {
  FacetId facet;
  SiteId owner;
  std::vector<PolygonCorner> corners;

  EdgeLabel edge_before(std::size_t k) const { return corners[previous_corner(k, corners.size())].edge; }
};

/// A corner of the polygon of `owner` on a facet, by itself: between the edges `before` and `after`.
struct CellCorner {
  FacetId facet;
  SiteId owner;
  EdgeLabel before, after;
  RoundedPoint point;
};

inline CellCorner cell_corner(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners,
                              std::size_t k) {
  return {facet, owner, corners[previous_corner(k, corners.size())].edge, corners[k].edge, corners[k].point};
}

enum class Clip { untouched, cut, swallowed };

/// Which part of a polygon is kept by a cut: corners first, first + 1, ... last, cyclically. The new corners
/// lie on the edges labelled `leaving`, from corner `last` on, and `entering`, which ends in corner `first`.
struct CutPlace {
  std::size_t first, last;
  EdgeLabel leaving, entering;
};

/// Clips facets of one mesh by bisectors of one set of sites. Copies share what is known of the facets;
/// clipping needs room for its work, so each thread has its own.
class Clipper {
 public:
  using Sites = Table<SiteId, WeightedPoint3>;

  /// Keeps references to both. All sites must stay within `extent` of the origin in every coordinate.
  Clipper(const TriMesh& mesh, const Sites& sites, double extent);

  Bisector bisector_of(SiteId owner, SiteId j) const { return bisector(sites_[owner], sites_[j], extent_); }

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
    return {b(Location3(point.position, levels_->at(facet, point.position))),
            off + std::abs(b.rise) * levels_->off(facet, point.tolerance)};
  }
  /// The same from the labels alone. Slow.
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
  RoundedPoint meeting(FacetId facet, const std::array<SiteId, 3>& sites, const AxisMinors& minors) const;
  /// No corner is farther than this from its rounded place.
  double most_tolerance() const { return 0x1p-32 * extent_; }

  /// What can be said of j and the owner on the whole facet from a ball about it: the owner wins everywhere
  /// (untouched), j does (swallowed), or it depends (cut).
  Clip compare_on_facet(FacetId facet, const Bisector& b) const {
    const Ball& ball = (*balls_)[facet];
    double f = b(ball.center), bound = b.error + b.length * ball.radius;
    if (b.rise != 0) f += b.rise * levels_->middle(facet), bound += std::abs(b.rise) * levels_->half(facet);
    return f > bound ? Clip::untouched : f < -bound ? Clip::swallowed : Clip::cut;
  }

  /// Does the ball about the facet meet that about x?
  bool comes_near(FacetId facet, const Vec3& x, double distance) const {
    const Ball& ball = (*balls_)[facet];
    const double far = (ball.radius + distance) * (1 + 1e-9);
    return (x - ball.center).squaredNorm() <= far * far;
  }

  /// That ball.
  const Vec3& middle(FacetId facet) const { return (*balls_)[facet].center; }
  double radius(FacetId facet) const { return (*balls_)[facet].radius; }

  /// An upper bound of the power, to the owner, of the locations in the polygon.
  double bound_power(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners) const;
  double bound_power(const FacetPolygon& polygon) const {
    return bound_power(polygon.facet, polygon.owner, polygon.corners);
  }

  /// Which corners j takes: none, some, all. O(corners). Fills `beaten` where the answer is `cut`.
  Clip classify_corners(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                        const Bisector& b, std::vector<char>& beaten) const;
  /// The same, with a look at the whole facet first.
  Clip classify(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                const Bisector& b, std::vector<char>& beaten) const {
    const Clip whole = compare_on_facet(facet, b);
    return whole != Clip::cut ? whole : classify_corners(facet, owner, corners, j, b, beaten);
  }

  /// Takes away what j beats. The new edge is labelled j. O(corners).
  Clip clip(FacetPolygon& polygon, SiteId j, const Bisector& b);
  Clip clip(FacetPolygon& polygon, SiteId j) { return clip(polygon, j, bisector_of(polygon.owner, j)); }
  /// Takes away what j does not beat: what is left is on j's side of the bisector.
  Clip clip_beyond(FacetPolygon& polygon, SiteId j, const Bisector& b);
  /// clip() with the answer of classify() at hand.
  void cut(FacetPolygon& polygon, SiteId j, const Bisector& b, const std::vector<char>& beaten);

  /// The values of a bisector at the corners of a facet.
  LinearForm form_on(FacetId facet, const Bisector& b) const {
    const auto [v0, v1, v2] = mesh_.facet(facet);
    if (b.rise == 0) return {{b(mesh_.position(v0)), b(mesh_.position(v1)), b(mesh_.position(v2))}, b.error};
    return linear_form(b, at(v0), at(v1), at(v2));
  }
  const FacetLevels& levels() const { return *levels_; }
  /// The corner of the owner's polygon between edges with these labels: what clip() computes there.
  RoundedPoint corner_between(FacetId facet, SiteId owner, EdgeLabel before, EdgeLabel after) const;

  /// The two halves of cut(): where, and the polygon with the new corners put in.
  static CutPlace place_of_cut(std::span<const PolygonCorner> corners, const std::vector<char>& beaten);
  static void cut(std::span<const PolygonCorner> old, const CutPlace& place, SiteId j,
                  const std::array<RoundedPoint, 2>& leave_and_enter, std::vector<PolygonCorner>& out);

 private:
  RankedPoint3 ranked(SiteId s) const { return {&sites_[s], s.value}; }
  Location3 at(VertexId v) const { return {mesh_.position(v), mesh_.level(v)}; }
  FacetCorners corners_of(FacetId t) const {
    const auto [v0, v1, v2] = mesh_.facet(t);
    return {&mesh_.position(v0),
            &mesh_.position(v1),
            &mesh_.position(v2),
            {mesh_.level(v0), mesh_.level(v1), mesh_.level(v2)}};
  }

  struct Ball {
    Vec3 center;
    double radius;  ///< rounded up
  };

  const TriMesh& mesh_;
  const Sites& sites_;
  double extent_;
  std::shared_ptr<const Table<FacetId, Ball>> balls_;  ///< around the facets
  std::shared_ptr<const FacetLevels> levels_;
  std::vector<char> beaten_;            // workspace
  std::vector<PolygonCorner> scratch_;  // workspace
};

}  // namespace geom
