#pragma once
// How far cells reach: of each site an upper bound of the power of the locations in its cell.

#include <limits>

#include "geom/dual/site_search.h"

namespace geom {

class Reaches {
 public:
  static constexpr double of_nothing = -std::numeric_limits<double>::infinity();

  /// Keeps a reference; that search knows the bounds of the sites that are in.
  explicit Reaches(SiteSearch& search) : search_(search) {}

  void reserve(std::size_t num_sites) { bounds_.reserve(num_sites); }
  /// Cells of further sites are empty.
  void resize(std::size_t num_sites) { bounds_.resize(num_sites, of_nothing); }
  /// Of an empty cell of_nothing.
  double operator[](SiteId p) const { return bounds_[p]; }
  void set(SiteId p, double bound) {
    bounds_[p] = bound;
    largest_ = std::max(largest_, bound);
    search_.tree().set_reach(p, bound);
  }
  void raise(SiteId p, double bound) {
    if (bound > bounds_[p]) set(p, bound);
  }
  /// The site is out.
  void forget(SiteId p) { bounds_[p] = of_nothing; }
  /// An upper bound of all. Amortised O(1).
  double largest();

 private:
  SiteSearch& search_;
  Table<SiteId, double> bounds_;
  double largest_ = 0;
  std::size_t asked_ = 0;  ///< since it was the largest one
};

}  // namespace geom
