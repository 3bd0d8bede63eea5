// Expansions against exact numbers of another make.

#include "geom/exact/expansion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/oracle/rational.h"

using geom::Expansion;
using geom::Rng;
using oracle::Rational;

namespace {

/// The same number twice.
struct Pair {
  Expansion expansion;
  Rational rational;
};

Pair operator+(const Pair& a, const Pair& b) { return {a.expansion + b.expansion, a.rational + b.rational}; }
Pair operator-(const Pair& a, const Pair& b) { return {a.expansion - b.expansion, a.rational - b.rational}; }
Pair operator*(const Pair& a, const Pair& b) { return {a.expansion * b.expansion, a.rational * b.rational}; }

Pair leaf(Rng& rng, double exponent_range) {
  const double x = rng.below(8) == 0 ? static_cast<double>(rng.below(4))
                                     : rng.uniform(-1, 1) * std::exp2(rng.uniform(-1, 1) * exponent_range);
  return {Expansion(x), Rational(x)};
}

/// Subtracts double after double, as large as what is left: nothing must remain on either side.
void compare(const Pair& number) {
  REQUIRE(number.expansion.sign() == number.rational.sign());
  Pair rest = number;
  for (int i = 0; i < 200 && rest.rational.sign() != 0; ++i) {
    const double top = rest.rational.approximate();
    CHECK(std::abs(rest.expansion.approximate() - top) <= 0x1p-50 * std::abs(top));
    rest = rest - Pair{Expansion(top), Rational(top)};
    REQUIRE(rest.expansion.sign() == rest.rational.sign());
  }
  CHECK(rest.rational.sign() == 0);
}

}  // namespace

TEST_CASE("expansions: the compiled arithmetic is exact") { CHECK_NOTHROW(geom::self_test()); }

TEST_CASE("expansions: differences and products of doubles are exact") {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const Pair a = leaf(rng, 60), b = leaf(rng, 60);
    const double x = a.rational.approximate(), y = b.rational.approximate();
    compare({Expansion::difference(x, y), a.rational - b.rational});
    compare({Expansion::product(x, y), a.rational * b.rational});
  }
}

TEST_CASE("expansions: random expressions equal those of exact numbers") {
  Rng rng(2);
  for (int i = 0; i < 3000; ++i) {
    std::vector<Pair> numbers;
    for (int k = 0; k < 6; ++k) numbers.push_back(leaf(rng, i % 3 == 0 ? 0 : i % 3 == 1 ? 20 : 60));
    for (int k = 0; k < 12; ++k) {  // degrees may double at each product: keep them small
      const Pair &a = numbers[rng.below(numbers.size())], &b = numbers[rng.below(6)];
      const auto operation = rng.below(4);
      numbers.push_back(operation == 0   ? a + b
                        : operation == 1 ? a - b
                        : k < 6          ? a * b
                                         : a - a * Pair{Expansion(1), 1});
    }
    for (const Pair& number : numbers) compare(number);
  }
}

// Sums of numbers far apart have many terms, more than fit without allocation.
TEST_CASE("expansions: long sums and their products") {
  Rng rng(4);
  std::size_t longest = 0;
  for (int i = 0; i < 200; ++i) {
    Pair sums[2];
    for (Pair& sum : sums)
      for (int k = 0; k < 12; ++k) sum = i % 2 == 0 ? sum + leaf(rng, 400) : leaf(rng, 400) - sum;
    const Pair product = sums[0] * sums[1];
    longest = std::max(longest, product.expansion.size());
    compare(product);
    Pair copy = product;
    copy = copy - sums[0] * sums[1];
    CHECK(copy.expansion.size() == 0);
    copy = product;
    CHECK((-copy.expansion + product.expansion).size() == 0);
  }
  CHECK(longest > 24);
}

TEST_CASE("expansions: the rounded value is off by less than a unit in the last place") {
  Rng rng(5);
  for (int i = 0; i < 5000; ++i) {
    Pair number = leaf(rng, 60) * leaf(rng, 60) - leaf(rng, 60) * leaf(rng, 60);
    // Leave the tail of a product behind: what was rounded away is now what counts.
    for (const auto cuts = rng.below(4); const auto cut : {0u, 1u, 2u})
      if (cut < cuts)
        number = number - Pair{Expansion(number.expansion.approximate()), number.expansion.approximate()};
    const double rounded = number.expansion.approximate(), size = std::abs(rounded);
    const Rational error = Rational(rounded) - number.rational, unit = std::nextafter(size, 1e300) - size;
    CHECK((error * error - unit * unit).sign() <= 0);
    CHECK((rounded > 0) - (rounded < 0) == number.rational.sign());
  }
}

// Beyond the valid range (expansion.h) results may be wrong; the program must not be.
TEST_CASE("expansions: underflow stays within the arrays") {
  for (const double tiny : {5e-324, 3e-310, 1e-200, 1e-160}) {
    const Expansion a = Expansion::difference(tiny, 1e-300), b = a * a, c = b * a + Expansion(tiny) - b;
    CHECK(c.size() < 50);
    CHECK((c * c - b).size() < 50);
  }
}

TEST_CASE("expansions: cancellation to zero and to the last bit") {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const Expansion a = leaf(rng, 40).expansion, b = leaf(rng, 40).expansion, c = leaf(rng, 40).expansion;
    const Expansion left = (a + b) * (a - b) * c, right = a * a * c - b * b * c;
    const Expansion zero = left - right;
    CHECK(zero.sign() == 0);
    CHECK(zero.size() == 0);
    const Expansion bit(0x1p-300);
    CHECK((left + bit - right).sign() == 1);
    CHECK((left - bit - right).sign() == -1);
    CHECK((-left + right - bit).sign() == -1);
    CHECK((zero * a).sign() == 0);
  }
}
