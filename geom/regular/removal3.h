#pragma once
// Removal of p from the triangulation in space. Let T be the triangulation before and T' after it; both are
// unique, weights being perturbed.
//
// - A tetrahedron of T without corner p has an orthosphere that excludes all sites, so it is in T' as well:
//   T' differs from T only in the hole, the star of p.
// - A corner of T' in the closed hole is either a corner of T, hence on the hole's boundary (the star has no
//   other corner inside than p): a site of the link; or hidden in T, with a witness in the star. (A hidden
//   site whose witness survives stays hidden.) These are the candidates.
// - So let a facet of T' have the hole on its positive side. One tetrahedron of T' lies there; its fourth
//   corner is a candidate and its orthosphere excludes all others: it is the one that ApexSearch finds.
//
// Beginning with the facets of the link, the hole is thus wrapped facet by facet, and what fills it are the
// tetrahedra of T', exposed hidden sites included. Facets met from both sides are closed.

#include <vector>

#include "geom/regular/facet_matcher.h"
#include "geom/regular/triangulation3.h"

namespace geom {

/// One object serves all removals of a triangulation.
class Removal3 {
 public:
  /// Removes a site, which is visible or hidden.
  void remove(Triangulation3& t, SiteId id);

 private:
  /// A facet of the hole; the hole is on the positive side of a, b, c.
  struct OpenFacet {
    SiteId a, b, c;
    TetrahedronFacet outer;  ///< the same facet of the tetrahedron outside
    bool closed = false;
  };
  void open_hole(Triangulation3& t, SiteId p);
  void fill_hole(Triangulation3& t);
  SiteId apex(const Triangulation3& t, const OpenFacet& facet) const;

  std::vector<OpenFacet> open_;
  std::vector<SiteId> candidates_;  ///< corners that tetrahedra in the hole may have
  std::vector<SiteId> displaced_;   ///< sites whose witness is destroyed
  FacetMatcher matcher_;
};

}  // namespace geom
