#pragma once
// What is known of the sites' cells (fast_way.h), with a search for those that are not regular.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/ids.h"
#include "geom/sites/site_grid.h"
#include "geom/vec.h"

namespace geom {

enum class CellShape : char { regular, irregular, unknown };

class SiteShapes {
 public:
  void reserve(std::size_t num_sites) {
    shape_.reserve(num_sites);
    place_of_.reserve(num_sites);
  }
  /// Sites are regular at first.
  void resize(std::size_t num_sites) {
    shape_.resize(num_sites, CellShape::regular);
    place_of_.resize(num_sites, 0);
  }
  CellShape operator[](SiteId p) const { return shape_[p]; }
  void set(SiteId p, CellShape shape, const Vec3& position);
  /// The site was elsewhere.
  void follow(SiteId p, const Vec3& from, const Vec3& to) {
    if (grid_.is_in_use() && shape_[p] != CellShape::regular) grid_.move(p, from, to);
  }
  /// Those that are not regular.
  std::span<const SiteId> not_regular() const { return not_regular_; }
  /// From now on these are found in cells of that size.
  void use_grid(double cell_size, const Table<SiteId, WeightedPoint3>& sites);
  /// Appends all that are that near to a location, and some more, if that is a quick search; else false.
  bool find_near(const Vec3& x, double distance, std::vector<SiteId>& out) const;

 private:
  Table<SiteId, CellShape> shape_;
  std::vector<SiteId> not_regular_;
  Table<SiteId, std::uint32_t> place_of_;  ///< there
  SiteGrid grid_;
};

}  // namespace geom
