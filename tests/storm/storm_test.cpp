// The storm for a few seconds, with every answer compared with the rational oracle too in some of the calls;
// and the integers below it.

#include <cmath>
#include <mutex>

#include "doctest.h"
#include "geom/parallel.h"
#include "tests/oracle/rational.h"
#include "tests/storm/trials.h"
#include "tests/storm/wide.h"

using storm::Kind;
using storm::Predicate;
using storm::Wide;

TEST_CASE("storm: sums, differences and products of wide integers have the signs of rational ones") {
  geom::Rng rng(11);
  const auto any = [&] {
    const double x = std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(500)) - 250);
    return rng.below(8) == 0 ? 0.0 : rng.below(4) == 0 ? 0x1p64 * std::nearbyint(x) : x;
  };
  constexpr long unit = -310;
  for (int i = 0; i < 20'000; ++i) {
    const double a = any(), b = any(), c = any(), d = any();
    const Wide A(a, unit), B(b, unit), C(c, unit), D(d, unit);
    const oracle::Rational a_(a), b_(b), c_(c), d_(d);
    CHECK((A - B).sign() == (a_ - b_).sign());
    CHECK((A * B - C * D).sign() == (a_ * b_ - c_ * d_).sign());
    CHECK((A * B * C + B.twice() * C * D).sign() ==
          (a_ * b_ * c_ + oracle::Rational(2) * b_ * c_ * d_).sign());
    // Equal expressions that are computed along other ways.
    CHECK(((A + B) * (C - D) - (A * C - A * D + B * C - B * D)).sign() == 0);
    CHECK(((A - B) * (A - B) * (A + B) - (A * A - B * B) * (A - B)).sign() == 0);
  }
}

TEST_CASE("storm: every exact predicate is right on every kind of draw, and so are all filters") {
  constexpr std::uint64_t each = 160;
  std::mutex mutex;
  std::string faults;
  const auto& kinds = Kind::all();
  const auto predicates = storm::predicates();
  std::vector<storm::Tally> tallies(predicates.size());
  geom::parallel_ranges(predicates.size() * kinds.size(), 1, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Predicate& predicate = predicates[i / kinds.size()];
      const Kind& kind = kinds[i % kinds.size()];
      try {
        const storm::Tally tally = run(predicate, kind, {each, i, 20});
        const std::lock_guard lock(mutex);
        tallies[i / kinds.size()] += tally;
      } catch (const storm::Fault& fault) {
        const std::lock_guard lock(mutex);
        faults += kind.name() + ": " + fault.what + "\n";
      }
    }
  });
  CHECK_MESSAGE(faults.empty(), faults);
  for (std::size_t i = 0; i < predicates.size(); ++i) {
    CAPTURE(predicates[i].name);
    CHECK(tallies[i].calls > each * kinds.size() / 2);  // some kinds meet no requirement of some predicates
    CHECK(tallies[i].unsure > tallies[i].calls / 50);
  }
}
