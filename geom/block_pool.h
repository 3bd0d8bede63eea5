#pragma once
// Memory for many small blocks that come and go.

#include <cstdint>
#include <memory>
#include <vector>

#include "geom/check.h"

namespace geom {

/// Blocks of elements, each in consecutive memory, named by the place where it begins. Memory comes in pages
/// that never move, so that growing copies nothing and needs nothing twice; blocks given back are used again
/// for others of the same kind. All blocks of one kind (a small number) have one size. O(1) amortised.
template <class T>
class BlockPool {
 public:
  using Place = std::uint32_t;

  /// The content is whatever it was. Throws Bug if there are 2^32 elements.
  Place take(std::size_t kind, std::size_t size) {
    if (kind < free_.size() && !free_[kind].empty()) {
      const Place block = free_[kind].back();
      free_[kind].pop_back();
      return block;
    }
    if (size > end_ - next_) add_pages(size);
    const auto place = static_cast<Place>(next_);
    next_ += size;
    return place;
  }

  /// The block must have been taken as one of this kind.
  void give_back(Place block, std::size_t kind) {
    if (kind >= free_.size()) free_.resize(kind + 1);
    free_[kind].push_back(block);
  }

  T* operator[](Place place) { return pages_[place >> page_bits] + (place & (page_size - 1)); }
  const T* operator[](Place place) const { return pages_[place >> page_bits] + (place & (page_size - 1)); }

 private:
  static constexpr std::size_t page_bits = sizeof(T) > 8 ? 12 : 14, page_size = std::size_t{1} << page_bits;
  static constexpr std::size_t most = 0xffffffffu;

  /// For a block of that size: more than one page only if one is too small. They follow each other in memory
  /// then.
  void add_pages(std::size_t size) {
    const std::size_t count = (size + page_size - 1) / page_size;
    ensure(end_ + count * page_size <= most, "block pool: too many elements in all");
    memory_.push_back(std::make_unique_for_overwrite<T[]>(count * page_size));
    for (std::size_t i = 0; i < count; ++i) pages_.push_back(memory_.back().get() + i * page_size);
    next_ = end_;
    end_ += count * page_size;
  }

  std::vector<std::unique_ptr<T[]>> memory_;
  std::vector<T*> pages_;
  std::size_t next_ = 0, end_ = 0;        ///< what is left of the last pages
  std::vector<std::vector<Place>> free_;  ///< by kind
};

}  // namespace geom
