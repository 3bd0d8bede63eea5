#pragma once
// Finds the two tetrahedra that share a facet while a star or a hole is being filled.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "geom/ids.h"

namespace geom {

/// An open-addressed hash table from unordered triples of sites to small numbers. Emptying it costs nothing
/// (entries of an earlier round are recognised by their round number); its memory only grows.
class FacetMatcher {
 public:
  /// Forgets everything.
  void clear() {
    used_ = 0;
    if (++round_ != 0) return;
    std::fill(entries_.begin(), entries_.end(), Entry{});
    round_ = 1;
  }

  /// The number stored for the facet {a, b, c}, or -1 if it was not there; then `value` is stored.
  std::int32_t find_or_insert(SiteId a, SiteId b, SiteId c, std::int32_t value) {
    if (2 * ++used_ > entries_.size()) grow();
    // Sorted without branches, which would be mispredicted.
    const std::int32_t least = std::min({a.value, b.value, c.value}),
                       most = std::max({a.value, b.value, c.value});
    const std::int32_t middle = (a.value ^ b.value ^ c.value) ^ (least ^ most);
    Entry& entry = place(SiteId(least), SiteId(middle), SiteId(most));
    if (entry.round == round_) return entry.value;
    entry = {SiteId(least), SiteId(middle), SiteId(most), value, round_};
    return -1;
  }

 private:
  struct Entry {
    SiteId a, b, c;  ///< ascending
    std::int32_t value = -1;
    std::uint32_t round = 0;
  };

  /// The entry of the facet, or the free one where it belongs.
  Entry& place(SiteId a, SiteId b, SiteId c) {
    const std::uint64_t hash =
        (word(a) * 0x9e3779b97f4a7c15u) ^ (word(b) * 0xc2b2ae3d27d4eb4fu) ^ (word(c) * 0x165667b19e3779f9u);
    const std::size_t mask = entries_.size() - 1;
    for (std::size_t i = (hash >> 32) & mask;; i = (i + 1) & mask) {
      Entry& entry = entries_[i];
      if (entry.round != round_ || (entry.a == a && entry.b == b && entry.c == c)) return entry;
    }
  }

  void grow() {
    std::vector<Entry> old(std::max<std::size_t>(256, 2 * entries_.size()));
    old.swap(entries_);
    for (const Entry& entry : old) {
      if (entry.round == round_) place(entry.a, entry.b, entry.c) = entry;
    }
  }

  static std::uint64_t word(SiteId id) { return static_cast<std::uint32_t>(id.value); }

  std::vector<Entry> entries_;  ///< a power of two of them, at most half of them used
  std::size_t used_ = 0;        ///< at least the number of entries of this round
  std::uint32_t round_ = 0;     ///< never 0 once in use
};

}  // namespace geom
