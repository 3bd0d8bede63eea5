#pragma once
// A list that is filled anew many times.

#include <cstddef>
#include <span>
#include <vector>

namespace geom {

/// add() hands out the next element as it was left, without constructing it; clear() keeps all. References
/// hold until the next add().
template <class T>
class Reused {
 public:
  Reused() = default;
  Reused(const Reused&) = delete;
  Reused& operator=(const Reused&) = delete;

  void clear() { size_ = 0; }
  T& add() {
    if (size_ == capacity_) [[unlikely]]
      grow();
    return first_[size_++];
  }
  void add(const T& item) { add() = item; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return first_[i]; }
  const T& operator[](std::size_t i) const { return first_[i]; }
  std::span<const T> items() const { return {first_, size_}; }

 private:
  [[gnu::noinline]] void grow() {
    items_.resize(2 * size_ + 16);
    first_ = items_.data();
    capacity_ = items_.size();
  }

  std::vector<T> items_;
  T* first_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace geom
