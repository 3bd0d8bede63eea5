#pragma once
// Levels: sheets of the surface that are near in space, set apart.
//
// A vertex may have a level, a fourth coordinate, and a location of a facet has that between its corners'
// levels. A site has the level of its place. Power is then that of four coordinates,
//
//     Pi(x, i) = |x - p_i|^2 + (u(x) - u_i)^2 - w_i,
//
// so that two sheets whose levels differ by more than cells are wide have nothing to do with each other,
// however near they are. On a facet u is affine, so the difference of two powers is affine there as without
// levels, and the restricted power diagram (paper, section 4.1) is one as ever: that of a surface in four
// dimensions. It covers the surface, is continuous across edges, and is a function of mesh, sites, weights
// and ids. Distances in space are no larger than those of four coordinates, so whatever is found by distance
// (site_tree.h) finds no less than all that matters.
//
// Where all facets and sites near have one level, differences of power are those of space.

#include <algorithm>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Levels of locations on facets, rounded. Empty if the mesh has none: all are 0.
class FacetLevels {
 public:
  explicit FacetLevels(const TriMesh& mesh);

  bool empty() const { return facets_.empty(); }
  /// Of a location of the facet, rounded or not: at most off() from that of the exact one.
  double at(FacetId t, const Vec3& x) const {
    if (empty()) return 0;
    const Facet& f = facets_[t];
    return f.least == f.most ? f.least : std::clamp(f.base + f.gradient.dot(x - f.origin), f.least, f.most);
  }
  /// `tolerance`: how far x is from the exact location, a coordinate at a time; may be infinite.
  double off(FacetId t, double tolerance) const {
    if (empty() || is_flat(t)) return 0;
    const Facet& f = facets_[t];
    return std::min(f.most - f.least, f.error + f.steepness * tolerance);
  }
  /// All of the facet has one level.
  bool is_flat(FacetId t) const { return empty() || facets_[t].least == facets_[t].most; }
  bool is_flat_at(FacetId t, double level) const {
    return empty() || (facets_[t].least == level && facets_[t].most == level);
  }
  /// The middle of the facet's levels, and how far they are from it at most.
  double middle(FacetId t) const { return empty() ? 0 : 0.5 * (facets_[t].least + facets_[t].most); }
  double half(FacetId t) const {
    return empty() ? 0 : 0.5 * (facets_[t].most - facets_[t].least) * (1 + 0x1p-50);
  }
  /// How far the facet's levels are from this one at least.
  double gap(FacetId t, double level) const {
    return empty() ? 0 : std::max({0.0, facets_[t].least - level, level - facets_[t].most});
  }

 private:
  struct Facet {
    double least, most, base, error, steepness;
    Vec3 origin, gradient;
  };
  Table<FacetId, Facet> facets_;
};

}  // namespace geom
