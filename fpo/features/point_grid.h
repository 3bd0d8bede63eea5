#pragma once
// Items by the cells of a cubic lattice.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "geom/vec.h"

namespace fpo {

/// The cell of a point, with edges of this length.
using GridCell = std::array<std::int64_t, 3>;
inline GridCell grid_cell(const geom::Vec3& at, double cell) {
  return {static_cast<std::int64_t>(std::floor(at.x() / cell)),
          static_cast<std::int64_t>(std::floor(at.y() / cell)),
          static_cast<std::int64_t>(std::floor(at.z() / cell))};
}

class PointGrid {
 public:
  /// Cells with edges of this length.
  explicit PointGrid(double cell) : cell_(cell) {}
  void add(const geom::Vec3& at, std::size_t item) { items_[grid_cell(at, cell_)].push_back(item); }

  /// Visits what is in the cells around: all within a cell's length, and more. Always in the same order.
  template <class Visit>
  void around(const geom::Vec3& at, Visit visit) const {
    const GridCell middle = grid_cell(at, cell_);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto found = items_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == items_.end()) continue;
          for (const std::size_t item : found->second) visit(item);
        }
  }

 private:
  double cell_;
  std::map<GridCell, std::vector<std::size_t>> items_;
};

}  // namespace fpo
