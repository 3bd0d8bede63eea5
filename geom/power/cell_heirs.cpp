#include "geom/power/cell_heirs.h"

namespace geom {

void CellHeirs::begin(SiteId p, std::span<const SiteId> excluded) {
  p_ = p;
  sites_.clear();
  ++stamp_;
  know(p);
  for (const SiteId s : excluded) know(s);
}

void CellHeirs::know(SiteId s) {
  if (s.index() >= known_stamp_.size()) known_stamp_.resize(s.index() + 1, 0);
  known_stamp_[s] = stamp_;
}

void CellHeirs::add(SiteId k) {
  know(k);
  sites_.push_back(k);
}

void CellHeirs::pair_up() {
  const std::size_t n = sites_.size();
  bisectors_.resize(n * n);
  for (Heir k = 0; k < n; ++k)
    for (Heir h = 0; h < k; ++h) {
      const Bisector b = clipper_.bisector_of(sites_[k], sites_[h]);
      bisectors_[k * n + h] = b;
      bisectors_[h * n + k] = {-b.normal, -b.offset, b.length, b.error, -b.rise};  // to the bit
    }
}

}  // namespace geom
