#include "io/png.h"

#include <algorithm>
#include <array>

#include "geom/check.h"

namespace io {
namespace {

/// Most significant byte first.
void append_32(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xff);
}

/// Least significant byte first.
void append_16(std::string& bytes, std::uint32_t value) {
  bytes += static_cast<char>(value & 0xff);
  bytes += static_cast<char>((value >> 8) & 0xff);
}

/// The checksum of a chunk (PNG specification, annex D).
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc;
}

/// The checksum of a zlib stream (RFC 1950).
std::uint32_t adler32(std::string_view bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return (b << 16) | a;
}

/// A zlib stream of stored blocks (RFC 1951, 3.2.4).
std::string stored(std::string_view bytes) {
  constexpr std::size_t largest_block = 65535;
  std::string stream = "\x78\x01";
  for (std::size_t at = 0; at < bytes.size(); at += largest_block) {
    const std::string_view block = bytes.substr(at, largest_block);
    const auto length = static_cast<std::uint32_t>(block.size());
    stream += at + largest_block >= bytes.size() ? '\1' : '\0';  // the last one?
    append_16(stream, length);
    append_16(stream, ~length);
    stream += block;
  }
  append_32(stream, adler32(bytes));
  return stream;
}

void append_chunk(std::string& png, std::string_view type, std::string_view data) {
  append_32(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = png.size();
  (png += type) += data;
  append_32(png, crc32(std::string_view(png).substr(start)));
}

}  // namespace

std::string gray_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> pixels) {
  geom::ensure(!pixels.empty() && pixels.size() == std::size_t{width} * height,
               "gray_png: pixels do not fit the size");
  std::string header;
  append_32(header, width);
  append_32(header, height);
  header.append({8, 0, 0, 0, 0});  // bits, gray, and the only methods that there are
  std::string rows;
  for (std::size_t y = 0; y < height; ++y) {
    rows += '\0';  // no filter
    for (const std::uint8_t pixel : pixels.subspan(y * width, width)) rows += static_cast<char>(pixel);
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", stored(rows));
  append_chunk(png, "IEND", {});
  return png;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = (group << 8) | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[(group >> (18 - 6 * k)) & 63] : '=';
  }
  return text;
}

}  // namespace io
