#pragma once
// A list that is filled anew many times.

#include <cstddef>
#include <span>
#include <vector>

namespace geom {

/// add() hands out the next element as it was left, without constructing it; clear() keeps all. References hold until
/// the next add().
template <class T>
class Reused {
 public:
  void clear() { size_ = 0; }
  T& add() {
    if (size_ == items_.size()) items_.resize(2 * size_ + 16);
    return items_[size_++];
  }
  void add(const T& item) { add() = item; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  std::span<const T> items() const { return std::span(items_).first(size_); }

 private:
  std::vector<T> items_;
  std::size_t size_ = 0;
};

}  // namespace geom
