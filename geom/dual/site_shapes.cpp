#include "geom/dual/site_shapes.h"

namespace geom {

void SiteShapes::set(SiteId p, CellShape shape, const Vec3& position) {
  if ((shape_[p] == CellShape::regular) != (shape == CellShape::regular)) {
    if (shape == CellShape::regular) {
      const SiteId last = not_regular_.back();
      not_regular_[place_of_[p]] = last;
      place_of_[last] = place_of_[p];
      not_regular_.pop_back();
      if (grid_.is_in_use()) grid_.remove(p, position);
    } else {
      if (grid_.is_in_use()) grid_.insert(p, position);
      place_of_[p] = static_cast<std::uint32_t>(not_regular_.size());
      not_regular_.push_back(p);
    }
  }
  shape_[p] = shape;
}

void SiteShapes::use_grid(double cell_size, const Table<SiteId, WeightedPoint3>& sites) {
  grid_ = SiteGrid(cell_size, 0);
  for (const SiteId p : not_regular_) grid_.insert(p, sites[p].position);
}

bool SiteShapes::find_near(const Vec3& x, double distance, std::vector<SiteId>& out) const {
  if (!grid_.is_in_use() || !grid_.is_short(distance)) return false;
  grid_.near(x, distance, out);
  return true;
}

}  // namespace geom
