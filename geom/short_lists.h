#pragma once
// Many short lists, each in consecutive memory: walking one is a single miss of the cache, where a
// linked list is one for each member.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/check.h"
#include "geom/ids.h"
#include "geom/prefetch.h"

namespace geom {

/// A list of Members (ids or small records) for each Key. A member's place in its list is told to the caller, who keeps it for
/// erase(): there the last member takes the place of the erased one. O(1) amortised; memory is used again and
/// no allocation happens once the tables have grown.
template <class Key, class Member>
class ShortLists {
 public:
  explicit ShortLists(std::size_t num_keys = 0) : lists_(num_keys) {}

  std::size_t num_keys() const { return lists_.size(); }
  /// Valid until the next push.
  std::span<const Member> operator[](Key key) const {
    if (key.index() >= lists_.size()) return {};
    return {pool_.data() + lists_[key].begin, lists_[key].size};
  }

  std::span<Member> operator[](Key key) {
    if (key.index() >= lists_.size()) return {};
    return {pool_.data() + lists_[key].begin, lists_[key].size};
  }

  /// Appends; returns the place.
  std::uint32_t push(Key key, Member member) {
    if (key.index() >= lists_.size()) lists_.resize(key.index() + 1);
    List& list = lists_[key];
    if (list.size == capacity(list)) grow(list);
    pool_[list.begin + list.size] = member;
    return list.size++;
  }

  /// Returns the member that is now at this place, or Member() if the erased one was the last.
  Member erase(Key key, std::uint32_t place) {
    List& list = lists_[key];
    const Member last = pool_[list.begin + --list.size];
    pool_[list.begin + place] = last;
    return place == list.size ? Member() : last;
  }

  void clear(Key key) {
    List& list = lists_[key];
    if (list.rank > 0) free_[list.rank].push_back(list.begin);
    list = {};
  }

  /// Asks the memory for what operator[] reads, then for what its result holds. No effect but on speed.
  void prefetch_list(Key key) const {
    if (key.index() < lists_.size()) prefetch(lists_.data() + key.index());
  }
  void prefetch_members(Key key) const {
    if (key.index() < lists_.size()) prefetch(pool_.data() + lists_[key].begin);
  }

 private:
  struct List {
    std::uint32_t begin = 0, size = 0;
    std::uint32_t rank = 0;  ///< of its block: room for 2 << rank members; 0: none
  };
  static std::uint32_t capacity(const List& list) { return list.rank == 0 ? 0 : 2u << list.rank; }

  void grow(List& list) {
    const std::uint32_t rank = list.rank + 1, room = 2u << rank;
    if (rank >= free_.size()) free_.resize(rank + 1);
    std::uint32_t begin;
    if (free_[rank].empty()) {
      ensure(pool_.size() + room <= 0xffffffffu, "short lists: too many members in all");
      begin = static_cast<std::uint32_t>(pool_.size());
      pool_.resize(pool_.size() + room);
    } else {
      begin = free_[rank].back();
      free_[rank].pop_back();
    }
    for (std::uint32_t i = 0; i < list.size; ++i) pool_[begin + i] = pool_[list.begin + i];
    if (list.rank > 0) free_[list.rank].push_back(list.begin);
    list.begin = begin;
    list.rank = rank;
  }

  Table<Key, List> lists_;
  std::vector<Member> pool_;                      ///< blocks of 4, 8, 16, ... members
  std::vector<std::vector<std::uint32_t>> free_;  ///< blocks by rank
};

}  // namespace geom
