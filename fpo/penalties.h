#pragma once
// How bad some things are, under change: for angle optimization (paper, section 5), in the plane and on
// surfaces.

#include <cstddef>
#include <utility>

#include "geom/ids.h"

namespace fpo {

/// Penalties of the bad among things with ids, and their sum. O(1) all.
template <class Id>
class Penalties {
 public:
  std::size_t number() const { return number_; }
  /// A running sum: off by rounding.
  double sum() const { return sum_; }
  /// 0: good, or unknown.
  double of(Id x) const { return x.index() < of_.size() ? of_[x] : 0; }
  /// All ids that may have one are smaller.
  std::size_t num_ids() const { return of_.size(); }

  /// Ids below that number are going to come.
  void reserve(std::size_t num_ids) { of_.reserve(num_ids); }
  /// x had none. Requires penalty > 0.
  void add(Id x, double penalty) {
    if (x.index() >= of_.size()) of_.resize(x.index() + 1, 0.0);
    of_[x] = penalty;
    sum_ += penalty;
    ++number_;
  }
  /// Whether it had one.
  bool forget(Id x) {
    if (of(x) == 0) return false;
    sum_ -= std::exchange(of_[x], 0.0);
    --number_;
    return true;
  }

 private:
  geom::Table<Id, double> of_;
  double sum_ = 0;
  std::size_t number_ = 0;
};

}  // namespace fpo
