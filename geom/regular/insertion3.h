#pragma once
// Insertion into the triangulation in space (Bowyer, Watson).
//
// The tetrahedra whose orthosphere contains p are those that die; they form the cavity, which is star-shaped
// as seen from p: each of its facets sees p on its inner side, strictly, because perturbed weights leave no
// flat tetrahedron in the result. Joining the facets to p fills it.
//
//        .-------.                .-------.
//       /|\     /|               /  \   / |      corners that were only inside the cavity
//      / | \ p / |              /    \ /  |      are hidden by p: they lie in the new star
//     .--+--.-+--.      ->     .------p---.      and get their witnesses there
//      \ | / \ | /              \    / \  /
//       \|/   \|/                \  /   \/
//        '-----'                  '-----'
//
// p itself is hidden iff it is not in conflict with a tetrahedron that contains it: lifted to the paraboloid
// less the weight it lies above the lower hull there.

#include <vector>

#include "geom/regular/facet_matcher.h"
#include "geom/regular/triangulation3.h"

namespace geom {

/// One object serves all insertions of a triangulation.
class Insertion3 {
 public:
  /// Inserts a site that is not in. Throws InputError, with nothing modified (Regular3::insert()).
  void insert(Triangulation3& t, SiteId id, const WeightedPoint3& point, SiteId hint);

 private:
  void dig_cavity(Triangulation3& t, SimplexId start, SiteId p);
  void star_cavity(Triangulation3& t, SiteId p);
  void hide_swallowed(Triangulation3& t);

  std::vector<TetrahedronFacet> boundary_;  ///< of the cavity: facets of destroyed simplices
  std::vector<SiteId> displaced_;           ///< sites whose witness is destroyed
  FacetMatcher matcher_;
};

}  // namespace geom
