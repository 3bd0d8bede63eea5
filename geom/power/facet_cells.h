#pragma once
// The restricted power diagram on one facet from nothing (paper, section 4.1), without the rest of the
// diagram: how a diagram of many sites is begun, on several threads.
//
//    +-----------------+     The cells on a facet hang together: from one owner the labels of its
//     \   a  |    b   /      fragment lead to the others. A fragment of p is the facet cut by the sites
//      \     |_______/       around p, nearest first, up to the security radius: if p has at most power R
//       \   /  c    /        anywhere on what is left, then j with |p_j - p| > sqrt(R + w_p) + sqrt(R + w_j)
//        \_/_______/         takes nothing of it.

#include <span>
#include <utility>
#include <vector>

#include "geom/power/clip.h"
#include "geom/sites/neighbour_oracle.h"

namespace geom {

/// One object a thread and set of sites. What is around a site is kept for the next facets: neighbours best
/// come one after the other.
class FacetCells {
 public:
  /// Keeps references, and a copy of the clipper. `search` must hold all sites, and answer any question of
  /// the whole space, from several threads: a SiteTree or a PointTree.
  FacetCells(const TriMesh& mesh, const Clipper::Sites& sites, const Clipper& clipper,
             const NearSites& search);

  /// All fragments on the facet, the same, to the bit, as insertion of the sites one by one leads to. Corners
  /// begin with the smallest label. Expected cost: the number of fragments, times the logarithm of that of
  /// sites. There must be at least one site, and the facet must not be degenerate. Valid until the next call.
  std::span<const FacetPolygon> divide(FacetId t);

  /// In all, around all owners: what the time depends on. For tests.
  std::size_t sites_looked_at() const { return sites_looked_at_; }

 private:
  struct Near {
    double distance;
    SiteId site;
    Bisector bisector;
  };
  /// All sites that take anything of the owner's where that has at most some power, nearest first.
  struct Surroundings {
    SiteId owner;
    double power = 0, heaviest = 0;
    std::vector<Near> sites;
  };

  SiteId nearest(const Location3& x);
  void follow(SiteId first, FacetId t);
  bool is_new(SiteId s);
  bool clip(FacetPolygon& polygon);
  bool clip(FacetPolygon& polygon, const Surroundings& around, double& bound);
  Surroundings& surroundings(SiteId owner);
  void look_around(Surroundings& around, double radius);
  void find_owners(FacetId t, SiteId first);

  const TriMesh& mesh_;
  const Clipper::Sites& sites_;
  Clipper clipper_;
  const NearSites& search_;
  std::vector<Surroundings> known_;  ///< of site s in place s mod size, if of s at all
  SiteId last_;                      ///< nearest to the facet before
  double likely_radius_ = 0;         ///< how far the next fragment will reach from its owner
  std::size_t sites_looked_at_ = 0;
  std::vector<FacetPolygon> found_;
  std::size_t num_found_ = 0;
  std::vector<SiteId> waiting_;                         ///< owners, perhaps, to be looked at
  std::vector<SiteId> candidates_;                      // workspace of a search
  std::vector<std::pair<double, SiteId>> by_distance_;  // workspace
  std::vector<SiteId> may_own_;                         // workspace of divide()
  Table<SiteId, std::uint32_t> stamp_of_;               ///< of the last facet where the site was met
  std::uint32_t stamp_ = 0;
};

/// Do the corners of the facet lie on one line? Exact. Such a facet spans no plane, in which three cells
/// would meet at one location, and that location is what the predicates for corners of type C ask about.
bool is_degenerate(const TriMesh& mesh, FacetId t);

/// All facets along a space-filling curve: a good order to divide them. O(F log F).
std::vector<FacetId> facets_along_curve(const TriMesh& mesh);

}  // namespace geom
