#pragma once
// Numbers in text, the same in every locale, and what is allowed as a coordinate.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace io {

/// The whole word as a decimal number (a leading '+' allowed), correctly rounded; "nan" and "inf" are numbers
/// here. A number too large for a double is an infinity.
std::optional<double> parse_real(std::string_view word);

/// The whole word as a decimal integer (a leading '+' allowed).
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Coordinates of greater magnitude are refused: the exact predicates hold up to 2^160 = 1.46e48
/// (geom/exact/expansion.h).
constexpr double largest_coordinate = 1e48;

/// What is wrong with a coordinate or weight (not finite, or beyond largest_coordinate), or null.
const char* coordinate_fault(double value);

/// Appends the shortest text that reads back as the same double.
void append_shortest(std::string& text, double value);
void append_integer(std::string& text, std::int64_t value);

/// Appends value rounded to `decimals` places, in few characters: "12", "-.5", "3.25".
void append_rounded(std::string& text, double value, int decimals);

}  // namespace io
