#pragma once
// What narrow places (curve_spacing.h) allow of the wanted length elsewhere.

#include <cstddef>
#include <limits>
#include <vector>

#include "fpo/features/curve_spacing.h"
#include "fpo/features/point_grid.h"

namespace fpo {

/// In widths: the wanted length in a strip: right triangles have 34 degrees then.
inline constexpr double widths_of_length = 1.5;

/// A k-d tree of the places whose boxes know their narrowest one.
class LengthLimits {
 public:
  /// Keeps a reference. Lengths from `most` on are not limited. O(places log places).
  LengthLimits(const std::vector<NarrowPlace>& places, double slope, double most);

  struct Limit {
    double length = std::numeric_limits<double>::infinity();
    double distance = std::numeric_limits<double>::infinity();
  };
  /// The least of 1.5 widths + slope * distance, and the least distance: of the places within most / slope,
  /// and of those farther ones that are in a cell of a lattice of that width beside that of x. Infinite if
  /// there is none. O(log places) where widths are alike.
  Limit at(const geom::Vec3& x) const;

 private:
  struct Node {
    geom::Box3 box;
    double least_width = std::numeric_limits<double>::infinity();
    std::size_t begin = 0, end = 0;  ///< in order_
    std::size_t second = 0;          ///< the other child; the first one follows its parent; 0: a leaf
  };
  struct Query;
  void build(std::size_t begin, std::size_t end);
  void look_at(std::size_t node, Query& query) const;

  const std::vector<NarrowPlace>& places_;
  double slope_, cell_;
  std::vector<std::size_t> order_;
  std::vector<GridCell> cells_;  ///< of the places
  std::vector<Node> nodes_;
};

}  // namespace fpo
