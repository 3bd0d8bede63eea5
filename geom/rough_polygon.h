#pragma once
// A facet clipped as in clip.h, by doubles alone, as long as all that is decided is certain: then the labels are those
// of exact clipping, at a fraction of the cost. Places of corners are not computed but for those that are left.
//
// A location of the facet is given by its weights (l_0, l_1, l_2) at the facet's corners, l_0 + l_1 + l_2 = 1, all in
// [0, 1], and a line by the values f_i of an affine function at these corners: f = sum f_i l_i. An edge of the facet
// is the line l_i = 0. Two lines F and G meet where l = (F x G) / sum (F x G).
//
// Errors. With m1, m2 the largest values of two forms and e1, e2 their errors, each component of F x G is off by at most
// e = 2 (m1 e2 + m2 e1) + 4u m1 m2, the sum by 3e + 12u m1 m2, so each l_i, which is exactly in [0, 1], by
// d = 1.01 (4e + 12u m1 m2) / |sum| + 8u. A form H there is off by its own error, by 3 max|H_i| d, and by roundings of
// at most 8u max|H_i| (3 products and 2 sums, of l_i no more than 1 + d, d < 1/2).

#include <array>
#include <cstdint>
#include <span>

#include "geom/clip.h"

namespace geom {

class RoughPolygon {
 public:
  enum class Outcome : char { untouched, cut, swallowed, unsure };

  /// The whole facet.
  void start();
  /// Keeps what is on the positive side. The new edge gets that label. If unsure, nothing more can be asked.
  Outcome clip(EdgeLabel label, const LinearForm& form);
  std::size_t size() const { return size_; }
  /// Of the edge from corner k on.
  EdgeLabel label(std::size_t k) const { return lines_[corners_[k].line].label; }

 private:
  static constexpr std::size_t most = 24;  ///< corners, and lines; beyond: unsure

  struct Line {
    EdgeLabel label;
    std::array<double, 3> f;
    double error, largest;
  };
  struct Corner {
    std::array<double, 3> weights;
    double off;
    std::uint32_t line;  ///< of the edge from here on
  };
  bool meet(std::uint32_t one, std::uint32_t two, Corner& out) const;

  std::array<Line, most> lines_;
  std::array<Corner, most> corners_;
  std::size_t size_ = 0, num_lines_ = 0;
};

}  // namespace geom
