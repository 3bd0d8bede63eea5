#pragma once
// The cell of a site that is inserted (paper, section 4.2, figure 6 (b)), put together facet by facet from what it took:
// each fragment of a rival that it cuts gives it one edge.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/clip.h"
#include "geom/fragment_store.h"

namespace geom {

/// The cuts of one insertion. No allocation once the tables have grown.
class CellAssembly {
 public:
  /// What the site took from the fragment of a rival: the new edge of that, from the edge `leaving` to the
  /// edge `entering`.
  struct Cut {
    SiteId rival;
    EdgeLabel leaving, entering;
    RoundedPoint leave{}, enter{};
    std::int32_t next = -1;  ///< on the same facet, index into the cuts or -1
  };
  struct TouchedFacet {
    FacetId facet;
    std::int32_t cuts = -1;  ///< head of a list of cuts
    FragmentId own;          ///< what the site had there before a move
    bool won = false;        ///< it has something there now
  };

  /// Keeps references. O(facets).
  CellAssembly(const TriMesh& mesh, const Clipper& clipper)
      : mesh_(mesh), clipper_(clipper), mark_(mesh.num_facets(), -1) {}

  void clear();
  /// Valid, like what touch() and win_on() return, until the next of these.
  std::span<const TouchedFacet> facets() const { return facets_; }

  TouchedFacet& touch(FacetId t) {
    std::int32_t& mark = mark_[t];
    if (mark < 0) {
      mark = static_cast<std::int32_t>(facets_.size());
      facets_.push_back({t, -1, FragmentId(), false});
    }
    return facets_[static_cast<std::size_t>(mark)];
  }
  TouchedFacet& win_on(FacetId t) {
    TouchedFacet& touched = touch(t);
    touched.won = true;
    return touched;
  }
  /// Notes what p takes from a rival's fragment on facet t and computes the ends of the new edge, where no other
  /// cut has them. b: the bisector of the rival with p.
  std::array<RoundedPoint, 2> add_cut(FacetId t, Cut cut, SiteId p, const Bisector& b);

  /// Puts p's fragment on that facet into `out`. Throws Bug if the edges do not close.
  void assemble(const TouchedFacet& touched, SiteId p, FacetPolygon& out) const;

 private:
  const Cut& cut_at(std::int32_t i) const { return cuts_[static_cast<std::size_t>(i)]; }
  const Cut* cut_of(FacetId t, SiteId rival) const;
  const Cut* cut_entered_from(const TouchedFacet& touched, EdgeLabel label) const;
  const RoundedPoint* known_corner(FacetId t, EdgeLabel label, SiteId rival) const;

  const TriMesh& mesh_;
  const Clipper& clipper_;
  std::vector<TouchedFacet> facets_;
  std::vector<Cut> cuts_;
  Table<FacetId, std::int32_t> mark_;  ///< index into facets_ or -1
};

}  // namespace geom
