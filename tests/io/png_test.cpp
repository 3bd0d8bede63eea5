#include "io/png.h"

#include <cstdint>
#include <string>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

namespace {

std::uint32_t read_32(const std::string& s, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = (value << 8) | static_cast<std::uint8_t>(s.at(at + k));
  return value;
}

/// What division of the polynomial leaves: of a message with its checksum always the same.
std::uint32_t crc_register(const std::string& bytes) {
  std::uint32_t r = 0xffffffff;
  for (const char c : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const std::uint32_t in = (static_cast<std::uint8_t>(c) >> bit) & 1;
      r = ((r ^ in) & 1) ? (r >> 1) ^ 0xedb88320 : r >> 1;
    }
  }
  return r;
}

struct Chunk {
  std::string type, data;
};

/// Takes a PNG apart; every length and checksum must be right.
std::vector<Chunk> chunks_of(const std::string& png) {
  REQUIRE(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t length = read_32(png, at);
    REQUIRE(at + 12 + length <= png.size());
    chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, length)});
    std::string reflected = png.substr(at + 4, 4 + length);  // the checksum goes in with its low bits first
    for (std::size_t k = 4; k-- > 0;) reflected += png[at + 8 + length + k];
    CHECK(crc_register(reflected) == 0xdebb20e3);
    at += 12 + length;
  }
  return chunks;
}

/// The bytes in stored blocks.
std::string unpacked(const std::string& stream) {
  CHECK(((static_cast<std::uint8_t>(stream[0]) << 8) | static_cast<std::uint8_t>(stream[1])) % 31 == 0);
  std::string bytes;
  std::size_t at = 2;
  for (bool last = false; !last;) {
    last = stream.at(at) == 1;
    const auto word = [&](std::size_t i) {
      return static_cast<std::uint8_t>(stream.at(i)) | (static_cast<std::uint8_t>(stream.at(i + 1)) << 8);
    };
    const int length = word(at + 1);
    CHECK((length ^ word(at + 3)) == 0xffff);
    bytes += stream.substr(at + 5, static_cast<std::size_t>(length));
    at += 5 + static_cast<std::size_t>(length);
  }
  std::uint64_t a = 1, b = 0;  // small enough to be reduced at the end only
  for (const char c : bytes) a += static_cast<std::uint8_t>(c), b += a;
  CHECK(read_32(stream, at) == (((b % 65521) << 16) | (a % 65521)));
  CHECK(at + 4 == stream.size());
  return bytes;
}

}  // namespace

TEST_CASE("gray_png: taken apart it has the pixels, with right lengths and checksums") {
  geom::Rng rng(1);
  for (const auto& [width, height] : {std::pair<std::uint32_t, std::uint32_t>{1, 1}, {7, 3}, {300, 500}}) {
    std::vector<std::uint8_t> pixels(std::size_t{width} * height);
    for (auto& p : pixels) p = static_cast<std::uint8_t>(rng.below(256));
    const std::vector<Chunk> chunks = chunks_of(io::gray_png(width, height, pixels));
    REQUIRE(chunks.size() == 3);
    CHECK((chunks[0].type == "IHDR" && chunks[1].type == "IDAT" && chunks[2].type == "IEND"));
    CHECK((read_32(chunks[0].data, 0) == width && read_32(chunks[0].data, 4) == height));
    CHECK(chunks[0].data.substr(8) == std::string("\x08\0\0\0\0", 5));
    std::string expected;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (i % width == 0) expected += '\0';
      expected += static_cast<char>(pixels[i]);
    }
    CHECK(unpacked(chunks[1].data) == expected);
  }
  CHECK_THROWS_AS(io::gray_png(2, 2, std::vector<std::uint8_t>(3)), geom::Bug);
}

TEST_CASE("base64: the examples of RFC 4648 and all bytes") {
  const char* const examples[][2] = {{"", ""},
                                     {"f", "Zg=="},
                                     {"fo", "Zm8="},
                                     {"foo", "Zm9v"},
                                     {"foob", "Zm9vYg=="},
                                     {"fooba", "Zm9vYmE="},
                                     {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : examples) CHECK(io::base64(bytes) == text);
  CHECK(io::base64("\xff\xef\xbe") == "/+++");
}
