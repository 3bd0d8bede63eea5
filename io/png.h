#pragma once
// Gray pictures as PNG, and bytes as text for putting one into an SVG.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace io {

/// An 8-bit gray PNG, row by row from the top; 0 is black. Not compressed: the bytes of the picture and about
/// 70 more. Requires width * height pixels, at least one.
std::string gray_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> pixels);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace io
