#include "geom/block_pool.h"

#include <numeric>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"

using namespace geom;

namespace {

struct Block {
  std::uint32_t place;
  std::size_t kind, size;
  std::uint64_t first;  ///< what it was filled with: this and the next numbers
};

bool is_intact(const BlockPool<std::uint64_t>& pool, const Block& block) {
  const std::uint64_t* const content = pool[block.place];
  for (std::size_t i = 0; i < block.size; ++i)
    if (content[i] != block.first + i) return false;
  return true;
}

}  // namespace

TEST_CASE("block pool: blocks that come and go keep what was written to them") {
  BlockPool<std::uint64_t> pool;
  std::vector<Block> blocks;
  Rng rng(5);
  std::uint64_t next = 0;
  for (int step = 0; step < 20000; ++step) {
    if (!blocks.empty() && rng.below(100) < 45) {
      const auto i = static_cast<std::size_t>(rng.below(blocks.size()));
      CHECK(is_intact(pool, blocks[i]));
      pool.give_back(blocks[i].place, blocks[i].kind);
      blocks[i] = blocks.back();
      blocks.pop_back();
      continue;
    }
    // Now and then one of several pages.
    const std::size_t kind = rng.below(2000) == 0 ? 9 : static_cast<std::size_t>(rng.below(9)),
                      size = kind == 9 ? 40000 : 1 + 3 * kind;
    blocks.push_back({pool.take(kind, size), kind, size, next});
    std::iota(pool[blocks.back().place], pool[blocks.back().place] + size, next);
    next += size;
  }
  for (const Block& block : blocks) CHECK(is_intact(pool, block));
}

TEST_CASE("block pool: a block given back is the next one of its kind, and blocks never move") {
  BlockPool<std::uint64_t> pool;
  const auto a = pool.take(0, 4), b = pool.take(1, 7);
  const std::uint64_t* const content = pool[b];
  pool.give_back(a, 0);
  CHECK(pool.take(1, 7) != a);
  for (int i = 0; i < 100000; ++i) pool.take(1, 7);
  CHECK(pool[b] == content);
  CHECK(pool.take(0, 4) == a);
  CHECK(pool.take(0, 4) != a);
}
