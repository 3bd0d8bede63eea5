#include "geom/sites/site_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geom/check.h"

namespace geom {

SiteGrid::SiteGrid(double cell_size, std::size_t num_sites) : inverse_(1 / cell_size) {
  std::size_t size = 64;
  while (size < num_sites) size *= 2;
  resize_table(size);
  buckets_.resize(1);
}

void SiteGrid::resize_table(std::size_t size) {
  table_.assign(size, 0);
  shift_ = 64 - (std::bit_width(size) - 1);
}

void SiteGrid::Bucket::set(std::uint32_t i, const Vec3& position, SiteId s) {
  x[i] = static_cast<float>(position.x());
  y[i] = static_cast<float>(position.y());
  z[i] = static_cast<float>(position.z());
  sites[i] = s;
}

std::int64_t SiteGrid::coordinate(double x) const {
  const double scaled = x * inverse_;
  const auto truncated = static_cast<std::int64_t>(scaled);
  return truncated - (scaled < static_cast<double>(truncated));
}

std::uint32_t SiteGrid::find(std::uint64_t key) const {
  for (std::size_t at = mixed(key);; ++at) {
    const std::uint32_t place = table_[at & (table_.size() - 1)];
    if (place == 0 || buckets_[place].key == key) return place;
  }
}

std::uint32_t SiteGrid::find_or_make(std::uint64_t key) {
  if (const std::uint32_t found = find(key)) return found;
  if (2 * buckets_.size() > table_.size()) grow();
  const auto place = static_cast<std::uint32_t>(buckets_.size());
  buckets_.emplace_back().key = key;
  std::size_t at = mixed(key);
  while (table_[at & (table_.size() - 1)] != 0) ++at;
  table_[at & (table_.size() - 1)] = place;
  return place;
}

void SiteGrid::grow() {
  std::vector<std::uint32_t> places;
  for (const std::uint32_t place : table_)
    if (place != 0) places.push_back(place);
  resize_table(2 * table_.size());
  for (const std::uint32_t place : places) {
    std::size_t at = mixed(buckets_[place].key);
    while (table_[at & (table_.size() - 1)] != 0) ++at;
    table_[at & (table_.size() - 1)] = place;
  }
}

void SiteGrid::insert(SiteId s, const Vec3& position) {
  slack_ = std::max(slack_, 0x1p-20 * position.lpNorm<Eigen::Infinity>());
  std::uint32_t place = find_or_make(key_at(position));
  while (buckets_[place].size == in_cell) {
    if (buckets_[place].overflow == 0) {
      const auto more = static_cast<std::uint32_t>(buckets_.size());
      buckets_.emplace_back();
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
    for (std::uint32_t i = 0; i < bucket.size; ++i) {
      if (bucket.sites[i] != s) continue;
      const std::uint32_t last = --bucket.size;
      bucket.set(i, {bucket.x[last], bucket.y[last], bucket.z[last]}, bucket.sites[last]);
      return;
    }
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
  for (std::int64_t i = x0; i <= x1; ++i)
    for (std::int64_t j = y0; j <= y1; ++j)
      for (std::int64_t k = z0; k <= z1; ++k)
        for (std::uint32_t place = find(key_of(i, j, k)); place != 0; place = buckets_[place].overflow) {
          const Bucket& bucket = buckets_[place];
          std::array<float, in_cell> distance2;
          for (std::size_t e = 0; e < in_cell; ++e) {
            const float dx = bucket.x[e] - x, dy = bucket.y[e] - y, dz = bucket.z[e] - z;
            distance2[e] = dx * dx + dy * dy + dz * dz;
          }
          for (std::uint32_t e = 0; e < bucket.size; ++e)
            if (distance2[e] <= limit2) out.push_back(bucket.sites[e]);
        }
}

}  // namespace geom
