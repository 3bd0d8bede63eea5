#pragma once
// One call of one exact predicate on a draw, compared with integers (wide_oracle.h) and, if asked, with the
// rational oracle too.

#include <cstdint>
#include <span>
#include <string>

#include "tests/storm/draws.h"

namespace storm {

/// A wrong answer: the points in hexadecimal, so that they can be had again.
struct Fault {
  std::string what;
};

struct Answer {
  bool asked;   ///< false: the draw does not meet what the predicate requires
  bool unsure;  ///< the filter left it to exact arithmetic
  bool tie;     ///< exactly degenerate: the perturbation decided, or the answer is 0
};

/// A function of geom/ that decides, or claims to know, something exact.
struct Predicate {
  const char* name;
  int degree;  ///< in the coordinates
  /// Throws Fault. `rational`: ask tests/oracle/rational.h as well, some hundred times slower.
  Answer (*ask)(const Kind& kind, const Range& range, bool rational, geom::Rng& rng);

  /// Where its polynomial neither over- nor underflows (geom/exact/predicates.h).
  Range range() const { return {-(1074 / degree), 1000 / degree - 4}; }
};

std::span<const Predicate> predicates();

struct Tally {
  std::uint64_t calls = 0, unsure = 0, ties = 0;
  Tally& operator+=(const Tally& other);
};

/// Asks until `count` draws could be asked, or 20 `count` were made. Every `rational_every`th is compared
/// with the rational oracle (0: none). A function of its arguments. Throws Fault.
struct Run {
  std::uint64_t count, seed, rational_every;
};
Tally run(const Predicate& predicate, const Kind& kind, const Run& run);

}  // namespace storm
