#pragma once
// The one random generator of the project: seeded, and the same sequence on every machine.

#include <cstdint>
#include <random>
#include <span>
#include <utility>

namespace geom {

/// std::mt19937_64 (whose sequence the standard fixes) with distributions of our own (which it does not fix).
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, ..., n - 1}, without bias. Requires n > 0.
  std::uint64_t below(std::uint64_t n);

  /// Fisher-Yates.
  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace geom
