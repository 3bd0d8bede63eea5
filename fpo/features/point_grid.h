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

class PointGrid {
 public:
  /// Cells with edges of this length.
  explicit PointGrid(double cell) : cell_(cell) {}
  void add(const geom::Vec3& at, std::size_t item) { items_[key(at)].push_back(item); }

  /// Visits what is in the cells around: all within a cell's length, and more. Always in the same order.
  template <class Visit>
  void around(const geom::Vec3& at, Visit visit) const {
    const Key middle = key(at);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto found = items_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == items_.end()) continue;
          for (const std::size_t item : found->second) visit(item);
        }
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  Key key(const geom::Vec3& at) const {
    return {static_cast<std::int64_t>(std::floor(at.x() / cell_)),
            static_cast<std::int64_t>(std::floor(at.y() / cell_)),
            static_cast<std::int64_t>(std::floor(at.z() / cell_))};
  }
  double cell_;
  std::map<Key, std::vector<std::size_t>> items_;
};

}  // namespace fpo
