#pragma once
// Numbers read strictly (the whole text or nothing) and written so that reading them gives the same value.

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

#include "geom/check.h"

namespace tools {

/// The shortest text that reads back as the same number.
std::string shortest(double value);

/// A finite decimal number in [low, high]. Throws geom::InputError: "'1.2x' is not a number", "7 is not
/// between 0 and 1".
double parse_number(std::string_view text, double low, double high);

/// Whether the text is digits, perhaps after a minus sign.
bool is_whole_number(std::string_view text);

/// A decimal whole number in [low, high]. Throws geom::InputError: "'12x' is not a whole number", "0 is not
/// between 1 and 9".
template <std::integral T>
T parse_integer(std::string_view text, T low, T high) {
  geom::require(is_whole_number(text), "'" + std::string(text) + "' is not a whole number");
  T value{};
  const bool fits = std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc{};
  geom::require(
      fits && low <= value && value <= high,
      std::string(text) + " is not between " + std::to_string(low) + " and " + std::to_string(high));
  return value;
}

}  // namespace tools
