#include "tools/numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tools {

std::string shortest(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

bool is_whole_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return '0' <= c && c <= '9'; });
}

double parse_number(std::string_view text, double low, double high) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  const bool number = whole && error != std::errc::invalid_argument && !std::isnan(value);
  geom::require(number, "'" + std::string(text) + "' is not a number");
  geom::require(error == std::errc{} && low <= value && value <= high && std::isfinite(value),
                std::string(text) + " is not between " + shortest(low) + " and " + shortest(high));
  return value;
}

}  // namespace tools
