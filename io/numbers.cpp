#include "io/numbers.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace io {

namespace {

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

template <class T>
std::from_chars_result parse(std::string_view word, T& value) {
  return std::from_chars(word.data(), word.data() + word.size(), value);
}

/// For words that from_chars calls out of range: 1e-400 is zero, 1e400 an infinity. Only the exponent can
/// tell them apart, and a long double has a wider one; what is beyond even that counts as infinite.
double beyond_double(std::string_view word) {
  long double wide = 0;
  if (parse(word, wide).ec != std::errc{}) return std::numeric_limits<double>::infinity();
  return static_cast<double>(wide);
}

}  // namespace

std::optional<double> parse_real(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [end, error] = parse(word, value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  return error == std::errc{} ? value : beyond_double(word);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = parse(word, value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

const char* coordinate_fault(double value) {
  if (std::isnan(value)) return "a coordinate is not a number (NaN)";
  if (std::isinf(value)) return "a coordinate is infinite or too large for a double";
  if (std::abs(value) > largest_coordinate)
    return "a coordinate is beyond 1e48, the range of the exact arithmetic";
  return nullptr;
}

void append_shortest(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_integer(std::string& text, std::int64_t value) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_rounded(std::string& text, double value, int decimals) {
  char digits[400];
  const auto written =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals);
  std::string_view number(digits, static_cast<std::size_t>(written.ptr - digits));
  if (number.find('.') != number.npos) {
    while (number.back() == '0') number.remove_suffix(1);
    if (number.back() == '.') number.remove_suffix(1);
  }
  const bool negative = number.front() == '-';
  if (negative) number.remove_prefix(1);
  if (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
  if (negative && number != "0") text += '-';
  text += number;
}

}  // namespace io
