#pragma once
// The priority queue of empty circles (paper, section 3.2): a max-heap whose entries can be erased and
// changed by slot.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geom/check.h"

namespace geom {

/// Max-heap over slots 0, 1, 2, ... (any typed id) with double keys. Among equal keys the slot that `first`
/// puts first is on top, so the order of the heap's content is a function of that content alone, not of its
/// history.
///
///   slot -> place_        entries_ : an implicit 4-ary tree, children of i at 4i+1 .. 4i+4
///
/// push, erase and update cost O(log n), top O(1). No allocation once the tables have grown. Keys must not be
/// NaN.
template <class Slot, class First>
class IndexedHeap {
 public:
  struct Entry {
    double key;
    Slot slot;
  };

  explicit IndexedHeap(First first = First()) : first_(std::move(first)) {}

  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  const Entry& top() const { return entries_.front(); }
  bool contains(Slot s) const { return s.index() < place_.size() && place_[s.index()] != absent; }
  double key(Slot s) const { return entries_[place_[s.index()]].key; }

  /// Slots below that number are going to come.
  void reserve(std::size_t num_slots) {
    if (num_slots > place_.size()) place_.resize(num_slots, absent);
  }
  void push(Slot s, double key) {
    if (s.index() >= place_.size()) place_.resize(2 * s.index() + 16, absent);
    entries_.push_back({key, s});
    rise(entries_.size() - 1, {key, s});
  }

  void erase(Slot s) {
    const std::size_t hole = place_[s.index()];
    place_[s.index()] = absent;
    const Entry last = entries_.back();
    entries_.pop_back();
    if (hole < entries_.size()) settle(hole, last);
  }

  void update(Slot s, double key) { settle(place_[s.index()], {key, s}); }

  /// Verifies the heap order and the places. O(n). Throws Bug.
  void check() const {
    std::size_t present = 0;
    for (const std::uint32_t p : place_) present += p != absent;
    ensure(present == entries_.size(), "heap: places and entries disagree in number");
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      ensure(place_[entries_[i].slot.index()] == i, "heap: an entry is not where its slot says");
      ensure(i == 0 || !before(entries_[i], entries_[parent(i)]), "heap: a child goes before its parent");
    }
  }

 private:
  static constexpr std::uint32_t absent = 0xffffffffu;
  static constexpr std::size_t arity = 4;
  static std::size_t parent(std::size_t i) { return (i - 1) / arity; }

  bool before(const Entry& a, const Entry& b) const {
    return a.key > b.key || (a.key == b.key && first_(a.slot, b.slot));
  }
  void put(std::size_t i, const Entry& e) {
    entries_[i] = e;
    place_[e.slot.index()] = static_cast<std::uint32_t>(i);
  }

  /// Puts e at i or above, moving later parents down.
  void rise(std::size_t i, const Entry& e) {
    for (; i > 0 && before(e, entries_[parent(i)]); i = parent(i)) put(i, entries_[parent(i)]);
    put(i, e);
  }
  /// Puts e at i or below, moving earlier children up.
  void sink(std::size_t i, const Entry& e) {
    for (;;) {
      const std::size_t begin = arity * i + 1, end = std::min(begin + arity, entries_.size());
      if (begin >= end) break;
      std::size_t best = begin;
      for (std::size_t c = begin + 1; c < end; ++c)
        if (before(entries_[c], entries_[best])) best = c;
      if (!before(entries_[best], e)) break;
      put(i, entries_[best]);
      i = best;
    }
    put(i, e);
  }
  void settle(std::size_t i, const Entry& e) {
    if (i > 0 && before(e, entries_[parent(i)]))
      rise(i, e);
    else
      sink(i, e);
  }

  First first_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> place_;
};

}  // namespace geom
