#pragma once
// The restricted power diagram of a surface as a whole (paper, section 4.1): every fragment, the part of one
// cell on one facet, with its polygon (clip.h). The optimization keeps the dual alone
// (dual/restricted_dual.h); this is built where cells are looked at: for output, measures, and to give parts
// of a cell to others.

#include <span>
#include <vector>

#include "geom/power/cell_division.h"
#include "geom/power/fragment_store.h"
#include "geom/sites/neighbour_oracle.h"

namespace geom {

class RestrictedPower {
 public:
  /// Of sites 0, 1, ..., at least one. Keeps a reference to the mesh. Throws InputError if that has no facet.
  /// `search` must hold all sites and answer from several threads: a SiteTree. The number of threads does not
  /// matter to the result. Cost: the facets and the fragments, times the logarithm of the number of sites.
  RestrictedPower(const TriMesh& mesh, std::span<const WeightedPoint3> points, const NeighbourOracle& search,
                  int threads = 1);
  RestrictedPower(const RestrictedPower&) = delete;

  /// Takes these fragments away from their owner p and divides them among the other sites, those in
  /// `excluded` left out, as if only there p did not exist. From then on the diagram is no power diagram.
  /// `search` must hold all sites. Does nothing, and says so, if no other site borders the fragments, or if
  /// the shares do not fit together because of what was abandoned before.
  bool abandon(SiteId p, std::span<const FragmentId> fragments, std::span<const SiteId> excluded,
               const NeighbourOracle& search);

  std::size_t num_sites() const { return sites_.size(); }
  const WeightedPoint3& site(SiteId p) const { return sites_[p]; }
  const FragmentStore& fragments() const { return store_; }
  const TriMesh& mesh() const { return mesh_; }
  /// An upper bound of the power of the locations in p's cell; -infinity if that is empty.
  double reach(SiteId p) const;

  /// A fragment by labels alone, the cycle starting at its smallest label.
  struct Canonical {
    FacetId facet;
    SiteId site;
    std::vector<EdgeLabel> labels;
    auto operator<=>(const Canonical&) const = default;
  };
  /// The whole diagram, sorted: equal diagrams give equal lists. For tests.
  std::vector<Canonical> canonical() const;
  /// Verifies lists, and labels on both sides of each bisector; throws Bug. O(fragments).
  void check() const;

 private:
  void commit(FragmentId f, const FacetPolygon& polygon);
  bool add_missing_heirs(SiteId p, const NeighbourOracle& source);
  struct Seam {
    std::size_t in_old, in_share;  ///< the edges labelled p
    bool fits;                     ///< and the edges next to them continue each other
  };
  Seam seam_of(FragmentId old, const FacetPolygon& share, SiteId p) const;
  void unite(FragmentId old, const FacetPolygon& share, SiteId p, FacetPolygon& out) const;

  const TriMesh& mesh_;
  Clipper::Sites sites_;
  Clipper clipper_;
  FragmentStore store_;
  CellDivision division_;
  std::vector<SiteId> candidates_;  // workspaces of abandon()
  FacetPolygon polygon_;
};

/// A bound of the magnitude of all coordinates of the surface and of locations rounded from it. Throws
/// InputError if it has no facet.
double extent_of(const TriMesh& mesh);

}  // namespace geom
