#pragma once
// How a part of a cell is divided among its heirs, the sites that own it if one does not (paper, section 4.2,
// figure 6 (c)): each share by itself, clipped from the whole facet. It needs nothing but the heirs.

#include <span>
#include <vector>

#include "geom/power/cell_heirs.h"
#include "geom/power/fragment_store.h"

namespace geom {

/// Plans the division, changes nothing. One object serves all divisions of a diagram.
class CellDivision {
 public:
  /// What an heir gets of one vacated fragment: a polygon in which the edge on the removed site's bisector,
  /// if there is one, is labelled with that site.
  struct Share {
    FragmentId joins;  ///< the fragment of the heir that continues it across that edge, or none: it is new
    FacetPolygon polygon;
  };

  /// Keeps references.
  CellDivision(Clipper& clipper, const FragmentStore& store)
      : clipper_(clipper), store_(store), heirs_(clipper) {}

  /// Starts anew: these fragments of p are to be divided. Heirs are the sites that their edges are labelled
  /// with, `excluded` left out.
  void begin(SiteId p, std::span<const FragmentId> vacated, std::span<const SiteId> excluded = {});
  /// Others may be added.
  CellHeirs& heirs() { return heirs_; }

  /// Divides among the present heirs (at least one). The share of heir k on facet t is clipped from
  /// { x in t : p beats k at x, and k beats every other heir at x }. misfit(): a share that should lie along
  /// the edge between p and k is empty.
  void divide();

  /// Of the last division; for the caller to move from or read.
  std::span<Share> shares() { return std::span(shares_).first(num_shares_); }
  bool misfit() const { return misfit_; }
  /// Is j nearer than the heirs somewhere in the vacated fragments? It is iff it is at a corner of the
  /// division that was not one of the cell, because the difference of two powers is affine on each share.
  bool is_missing(SiteId j) const;
  /// An upper bound of the power, after the division, at those corners.
  double max_radius2() const;

 private:
  using Heir = CellHeirs::Heir;

  void clip_shares(FragmentId vacated);
  void order_heirs(FragmentId vacated);
  void prepare();
  Share& add_share();

  Clipper& clipper_;
  const FragmentStore& store_;
  CellHeirs heirs_;
  std::vector<FragmentId> vacated_;
  std::vector<Share> shares_;
  std::size_t num_shares_ = 0;
  std::vector<CellCorner> corners_;  ///< of the division; maybe more than once, with different owners
  bool misfit_ = false;

  std::vector<Heir> order_;  ///< those that matter most on the facet in hand first
};

}  // namespace geom
