#pragma once
// Sites of about even density by position: a grid of cubes, those that hold something in a table.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/ids.h"
#include "geom/vec.h"

namespace geom {

/// insert, move, near: O(1) expected, and the sites near. Coordinates divided by the cell size must stay
/// below 2^20.
class SiteGrid {
 public:
  /// Without cells: is_in_use() is false, and nothing may be asked or done.
  SiteGrid() = default;
  SiteGrid(double cell_size, std::size_t num_sites);
  bool is_in_use() const { return inverse_ > 0; }

  void insert(SiteId s, const Vec3& position);
  void remove(SiteId s, const Vec3& position);
  void move(SiteId s, const Vec3& from, const Vec3& to);
  /// Appends all sites within that distance of the center, and a few more.
  void near(const Vec3& center, double distance, std::vector<SiteId>& out) const;
  /// Is a search of that radius a matter of a few cells?
  bool is_short(double distance) const { return distance * inverse_ < 2.5; }

 private:
  static constexpr std::size_t in_cell = 8;
  struct Bucket {
    std::uint64_t key = 0;
    std::uint32_t size = 0;
    std::uint32_t overflow = 0;          ///< place of another bucket of the same cell, or 0
    std::array<float, in_cell> x, y, z;  ///< rounded; beyond the size: infinite
    std::array<SiteId, in_cell> sites;
    Bucket();
    void set(std::uint32_t i, const Vec3& position, SiteId s);
    void remove(std::uint32_t i);
    /// Bit i: the i-th site is that near.
    [[gnu::noinline]] std::uint32_t near(float to_x, float to_y, float to_z, float limit2) const;
  };

  std::int64_t coordinate(double x) const;
  static std::uint64_t key_of(std::int64_t i, std::int64_t j, std::int64_t k) {
    constexpr std::int64_t bias = 1 << 20;
    return static_cast<std::uint64_t>(i + bias) << 42 | static_cast<std::uint64_t>(j + bias) << 21 |
           static_cast<std::uint64_t>(k + bias);
  }
  std::uint64_t key_at(const Vec3& x) const {
    return key_of(coordinate(x.x()), coordinate(x.y()), coordinate(x.z()));
  }
  /// The place of the cell's first bucket, or 0.
  std::uint32_t find(std::uint64_t key) const { return find(key, begin_of(key)); }
  std::uint32_t find(std::uint64_t key, std::size_t begin) const {
    const std::uint32_t* const table = table_.data();
    for (std::size_t at = begin;; ++at) {
      const std::uint32_t place = table[at & last_];
      if (place == 0 || buckets_[place].key == key) return place;
    }
  }
  std::uint32_t find_or_make(std::uint64_t key);
  std::uint32_t make_bucket();
  void grow();
  void resize_table(std::size_t size);
  /// Where the search for a cell begins. Cells of a row along z are next to each other.
  std::size_t begin_of(std::uint64_t key) const {
    constexpr int bits = 21;
    const std::uint64_t row = key >> bits, along = key & ((1 << bits) - 1);
    return static_cast<std::size_t>(((row * 0x9e3779b97f4a7c15u) >> shift_) + along);
  }

  double inverse_ = 0;                ///< of the cell size
  double slack_ = 0;                  ///< more than a rounded position is off
  int shift_ = 0;                     ///< 64 - log2 of the size of the table
  std::size_t last_ = 0;              ///< place there
  std::vector<std::uint32_t> table_;  ///< open addressing: places of buckets, 0: none
  std::vector<Bucket> buckets_;       ///< the first one is not used; cells are never given up
};

}  // namespace geom
