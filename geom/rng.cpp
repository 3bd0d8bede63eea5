#include "geom/rng.h"

namespace geom {

std::uint64_t Rng::below(std::uint64_t n) {
  const std::uint64_t biased = (0 - n) % n;  // 2^64 mod n: values below it would be drawn once too often
  for (;;) {
    const std::uint64_t x = bits();
    if (x >= biased) return x % n;
  }
}

}  // namespace geom
