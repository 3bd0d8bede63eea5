#include "geom/sites/site_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace geom {

SiteGrid::SiteGrid(double cell_size, std::size_t num_sites) : inverse_(1 / cell_size) {
  std::size_t size = 64;
  while (size < 2 * num_sites) size *= 2;
  resize_table(size);
  buckets_.resize(1);
}

void SiteGrid::resize_table(std::size_t size) {
  table_.assign(size, 0);
  last_ = size - 1;
  shift_ = 64 - (std::bit_width(size) - 1);
}

SiteGrid::Bucket::Bucket() {
  x.fill(std::numeric_limits<float>::infinity());
  y.fill(0);
  z.fill(0);
}

void SiteGrid::Bucket::set(std::uint32_t i, const Vec3& position, SiteId s) {
  x[i] = static_cast<float>(position.x());
  y[i] = static_cast<float>(position.y());
  z[i] = static_cast<float>(position.z());
  sites[i] = s;
}

void SiteGrid::Bucket::remove(std::uint32_t i) {
  const std::uint32_t last = --size;
  x[i] = x[last];
  y[i] = y[last];
  z[i] = z[last];
  sites[i] = sites[last];
  x[last] = std::numeric_limits<float>::infinity();
}

/// All of a bucket at once, without a branch: a loop that becomes vector instructions, unless it is part of
/// another one.
std::uint32_t SiteGrid::Bucket::near(float to_x, float to_y, float to_z, float limit2) const {
  static constexpr std::array<std::uint32_t, in_cell> bit{1, 2, 4, 8, 16, 32, 64, 128};
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < in_cell; ++i) {
    const float dx = x[i] - to_x, dy = y[i] - to_y, dz = z[i] - to_z;
    near |= -static_cast<std::uint32_t>(dx * dx + dy * dy + dz * dz <= limit2) & bit[i];
  }
  return near;
}

std::int64_t SiteGrid::coordinate(double x) const {
  const double scaled = x * inverse_;
  const auto truncated = static_cast<std::int64_t>(scaled);
  return truncated - (scaled < static_cast<double>(truncated));
}

/// Of a sixth of all memory at 10^6 sites: it grows by an eighth, where a vector would by half or all.
std::uint32_t SiteGrid::make_bucket() {
  constexpr std::size_t share = 8, few = 64;
  const std::size_t size = buckets_.size();
  if (size == buckets_.capacity()) buckets_.reserve(size + size / share + few);
  buckets_.emplace_back();
  return static_cast<std::uint32_t>(size);
}

std::uint32_t SiteGrid::find_or_make(std::uint64_t key) {
  if (const std::uint32_t found = find(key)) return found;
  if (4 * buckets_.size() > table_.size()) grow();
  const std::uint32_t place = make_bucket();
  buckets_[place].key = key;
  std::size_t at = begin_of(key);
  while (table_[at & last_] != 0) ++at;
  table_[at & last_] = place;
  return place;
}

void SiteGrid::grow() {
  std::vector<std::uint32_t> places;
  for (const std::uint32_t place : table_)
    if (place != 0) places.push_back(place);
  resize_table(2 * table_.size());
  for (const std::uint32_t place : places) {
    std::size_t at = begin_of(buckets_[place].key);
    while (table_[at & last_] != 0) ++at;
    table_[at & last_] = place;
  }
}

void SiteGrid::insert(SiteId s, const Vec3& position) {
  slack_ = std::max(slack_, 0x1p-20 * position.lpNorm<Eigen::Infinity>());
  std::uint32_t place = find_or_make(key_at(position));
  while (buckets_[place].size == in_cell) {
    if (buckets_[place].overflow == 0) {
      const std::uint32_t more = make_bucket();
      buckets_[place].overflow = more;
    }
    place = buckets_[place].overflow;
  }
  Bucket& bucket = buckets_[place];
  bucket.set(bucket.size++, position, s);
}

void SiteGrid::remove(SiteId s, const Vec3& position) {
  for (std::uint32_t place = find(key_at(position)); place != 0; place = buckets_[place].overflow) {
    Bucket& bucket = buckets_[place];
    for (std::uint32_t i = 0; i < bucket.size; ++i)
      if (bucket.sites[i] == s) return bucket.remove(i);
  }
  throw Bug("site grid: a site is not where it should be");
}

void SiteGrid::move(SiteId s, const Vec3& from, const Vec3& to) {
  const std::uint64_t key = key_at(to);
  if (key == key_at(from)) {
    slack_ = std::max(slack_, 0x1p-20 * to.lpNorm<Eigen::Infinity>());
    for (std::uint32_t place = find(key); place != 0; place = buckets_[place].overflow)
      for (std::uint32_t i = 0; i < buckets_[place].size; ++i)
        if (buckets_[place].sites[i] == s) return buckets_[place].set(i, to, s);
  }
  remove(s, from);
  insert(s, to);
}

// In single precision; the slack has room for all that is rounded.
void SiteGrid::near(const Vec3& center, double distance, std::vector<SiteId>& out) const {
  const double far = distance + slack_;
  const auto limit2 = static_cast<float>(far * far * (1 + 1e-5));
  const auto x = static_cast<float>(center.x()), y = static_cast<float>(center.y()),
             z = static_cast<float>(center.z());
  const std::int64_t x0 = coordinate(center.x() - far), x1 = coordinate(center.x() + far),
                     y0 = coordinate(center.y() - far), y1 = coordinate(center.y() + far),
                     z0 = coordinate(center.z() - far), z1 = coordinate(center.z() + far);
  const auto deep = static_cast<std::size_t>(z1 - z0);
  for (std::int64_t i = x0; i <= x1; ++i)
    for (std::int64_t j = y0; j <= y1; ++j) {
      const std::uint64_t key = key_of(i, j, z0);
      const std::size_t begin = begin_of(key);
      for (std::size_t k = 0; k <= deep; ++k)
        for (std::uint32_t place = find(key + k, begin + k); place != 0; place = buckets_[place].overflow) {
          const Bucket& bucket = buckets_[place];
          for (std::uint32_t near = bucket.near(x, y, z, limit2); near != 0; near &= near - 1)
            out.push_back(bucket.sites[static_cast<std::size_t>(std::countr_zero(near))]);
        }
    }
}

}  // namespace geom
