#pragma once
// A facet clipped as in clip.h, known by its labels alone: what a cut takes is decided by doubles where they
// are certain, else by the exact tests, which need no more than labels. Places are computed for those corners
// only that are left.
//
// A location of the facet is given by its weights (l_0, l_1, l_2) at the facet's corners, l_0 + l_1 + l_2 =
// 1, all in [0, 1], and a line by the values f_i of an affine function at these corners: f = sum f_i l_i. An
// edge of the facet is the line l_i = 0. Two lines F and G meet where l = (F x G) / sum (F x G).
//
// Errors. With m1, m2 the largest values of two forms and e1, e2 their errors, each component of F x G is off
// by at most e = 2 (m1 e2 + m2 e1) + 4u m1 m2, the sum by 3e + 12u m1 m2, so each l_i, which is exactly in
// [0, 1], by d = 1.01 (4e + 12u m1 m2) / |sum| + 8u. A form H there is off by its own error, by 3 max|H_i| d,
// and by roundings of at most 8u max|H_i| (3 products and 2 sums, of l_i no more than 1 + d, d < 1/2).

#include <array>
#include <cstdint>
#include <vector>

#include "geom/power/clip.h"

namespace geom {

class LazyPolygon {
 public:
  /// Keeps a reference.
  explicit LazyPolygon(const Clipper& clipper) : clipper_(clipper) {}

  /// The whole facet.
  void start(FacetId facet, SiteId owner);
  /// Takes away what j beats; the new edge is labelled j. `b` is that of owner and j. What is swallowed is of
  /// no more use.
  Clip clip(SiteId j, const Bisector& b) { return cut(j, b, true); }
  /// Takes away what j does not beat.
  Clip clip_beyond(SiteId j, const Bisector& b) { return cut(j, b, false); }

  /// The polygon with its corners. known(before, after): the corner between edges with these labels, or null.
  template <class Known>
  void place(FacetPolygon& out, Known known) const {
    const std::size_t n = corners_.size();
    out.facet = facet_;
    out.owner = owner_;
    out.corners.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      const EdgeLabel before = label(previous_corner(k, n)), after = label(k);
      const RoundedPoint* point = known(before, after);
      out.corners[k] = {point ? *point : clipper_.corner_between(facet_, owner_, before, after), after};
    }
  }
  void place(FacetPolygon& out) const {
    place(out, [](EdgeLabel, EdgeLabel) -> const RoundedPoint* { return nullptr; });
  }

 private:
  struct Line {
    EdgeLabel label;
    std::array<double, 3> f;
    double error, largest;
  };
  struct Corner {
    std::array<double, 3> weights;
    double off;          ///< infinite: nothing is known of the weights
    std::uint32_t line;  ///< of the edge from here on
    bool is_lost;        ///< by the cut in hand
  };

  Clip cut(SiteId j, const Bisector& b, bool is_loser_beaten);
  bool is_beaten_exactly(std::size_t k, SiteId j) const;
  Corner meet(std::uint32_t one, std::uint32_t two, std::uint32_t next) const;
  /// Of the edge from corner k on.
  EdgeLabel label(std::size_t k) const { return lines_[corners_[k].line].label; }

  const Clipper& clipper_;
  FacetId facet_;
  SiteId owner_;
  std::vector<Line> lines_;
  std::vector<Corner> corners_;
  std::vector<Corner> left_;  // workspace
};

}  // namespace geom
