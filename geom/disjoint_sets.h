#pragma once
// Sets of integers below 2^32 that are merged: components, fans.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace geom {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void merge(std::size_t a, std::size_t b) { parent_[find(a)] = static_cast<std::uint32_t>(find(b)); }
  /// The smaller of the two representatives stands for both: so each set is known by its least member.
  void merge_to_least(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    parent_[a < b ? b : a] = static_cast<std::uint32_t>(a < b ? a : b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace geom
