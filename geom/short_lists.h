#pragma once
// Many short lists, each in consecutive memory: walking one is a single miss of the cache, where a
// linked list is one for each member.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/block_pool.h"
#include "geom/check.h"
#include "geom/ids.h"
#include "geom/prefetch.h"

namespace geom {

/// A list of Members (ids or small records) for each Key. A member's place in its list is told to the caller,
/// who keeps it for erase(): there the last member takes the place of the erased one. O(1) amortised; memory
/// is used again and no allocation happens once the tables have grown.
template <class Key, class Member>
class ShortLists {
 public:
  explicit ShortLists(std::size_t num_keys = 0) : lists_(num_keys) {}

  std::size_t num_keys() const { return lists_.size(); }
  /// Valid until the next push.
  std::span<const Member> operator[](Key key) const {
    if (key.index() >= lists_.size()) return {};
    return members(lists_[key]);
  }

  std::span<Member> operator[](Key key) {
    if (key.index() >= lists_.size()) return {};
    return members(lists_[key]);
  }

  /// Appends; returns the place.
  std::uint32_t push(Key key, Member member) {
    if (key.index() >= lists_.size()) lists_.resize(key.index() + 1);
    List& list = lists_[key];
    if (list.size == capacity(list.rank)) grow(list);
    pool_[list.begin][list.size] = member;
    return list.size++;
  }

  /// Returns the member that is now at this place, or Member() if the erased one was the last.
  Member erase(Key key, std::uint32_t place) {
    List& list = lists_[key];
    Member* const members = pool_[list.begin];
    const Member last = members[--list.size];
    members[place] = last;
    return place == list.size ? Member() : last;
  }

  void clear(Key key) {
    List& list = lists_[key];
    if (list.rank > 0) pool_.give_back(list.begin, list.rank);
    list = {};
  }

  /// Asks the memory for what operator[] reads, then for what its result holds. No effect but on speed.
  void prefetch_list(Key key) const {
    if (key.index() < lists_.size()) prefetch(lists_.data() + key.index());
  }
  void prefetch_members(Key key) const {
    if (key.index() < lists_.size() && lists_[key].rank > 0) prefetch(pool_[lists_[key].begin]);
  }

 private:
  struct List {
    std::uint32_t begin = 0;
    std::uint32_t size : 26 = 0;
    std::uint32_t rank : 6 = 0;  ///< of its block; 0: none
  };
  /// Of blocks by rank: 4, 6, 8, 12, 16, 24, ... members.
  static std::uint32_t capacity(std::uint32_t rank) {
    return rank == 0 ? 0 : (rank % 2 == 1 ? 4u : 3u) << rank / 2;
  }

  std::span<const Member> members(const List& list) const {
    if (list.rank == 0) return {};
    return {pool_[list.begin], list.size};
  }
  std::span<Member> members(const List& list) {
    if (list.rank == 0) return {};
    return {pool_[list.begin], list.size};
  }

  void grow(List& list) {
    const std::uint32_t rank = list.rank + 1;
    ensure(capacity(rank) < 1u << 26, "short lists: too many members in one");
    const std::uint32_t begin = pool_.take(rank, capacity(rank));
    if (list.rank > 0) {
      std::copy_n(pool_[list.begin], list.size, pool_[begin]);
      pool_.give_back(list.begin, list.rank);
    }
    list.begin = begin;
    list.rank = rank;
  }

  Table<Key, List> lists_;
  BlockPool<Member> pool_;  ///< the kind of a block is its rank
};

}  // namespace geom
