#include "io/pgm.h"

#include <algorithm>
#include <string>

#include "io/input_file.h"
#include "io/text_cursor.h"

namespace io {
namespace {

constexpr std::int64_t longest_side = 32768, most_value = 65535;

std::int64_t header_number(TextCursor& cursor, const char* what, std::int64_t most) {
  const std::int64_t number = cursor.integer(cursor.word_across_lines(), what);
  if (number < 1 || number > most)
    cursor.fail("the " + std::string(what) + " " + std::to_string(number) + " is not between 1 and " +
                std::to_string(most));
  return number;
}

void read_text(TextCursor& cursor, std::int64_t largest, std::size_t count, std::vector<float>& out) {
  while (out.size() < count) {
    const std::string_view word = cursor.word_across_lines();
    if (word.empty())
      cursor.fail("the image ends after " + std::to_string(out.size()) + " of " + std::to_string(count) +
                  " values");
    const std::int64_t value = cursor.integer(word, "value");
    if (value < 0 || value > largest)
      cursor.fail("the value " + std::to_string(value) + " is not between 0 and " + std::to_string(largest));
    out.push_back(static_cast<float>(static_cast<double>(value) / static_cast<double>(largest)));
  }
}

/// 16-bit values have the high byte first.
void read_binary(const InputFile& file, std::size_t at, std::int64_t largest, std::size_t count,
                 std::vector<float>& out) {
  const std::size_t width = largest > 255 ? 2 : 1;
  const std::size_t there = at <= file.bytes.size() ? (file.bytes.size() - at) / width : 0;
  if (there < count)
    file.fail({file.bytes.size(), Unit::byte},
              "the image ends after " + std::to_string(there) + " of " + std::to_string(count) + " values");
  const auto byte = [&](std::size_t i) { return std::int64_t{static_cast<unsigned char>(file.bytes[i])}; };
  for (std::size_t i = at; out.size() < count; i += width) {
    const std::int64_t value = width == 1 ? byte(i) : 256 * byte(i) + byte(i + 1);
    if (value > largest)
      file.fail({i, Unit::byte},
                "the value " + std::to_string(value) + " is not between 0 and " + std::to_string(largest));
    out.push_back(static_cast<float>(static_cast<double>(value) / static_cast<double>(largest)));
  }
}

}  // namespace

GrayImage read_pgm(const std::filesystem::path& path) {
  const InputFile file = load(path);
  TextCursor cursor(file);
  const std::string_view magic = cursor.word_across_lines();
  if (magic != "P2" && magic != "P5") file.fail("is no PGM image (it starts with neither P2 nor P5)");
  GrayImage image;
  image.width = static_cast<std::size_t>(header_number(cursor, "width", longest_side));
  image.height = static_cast<std::size_t>(header_number(cursor, "height", longest_side));
  const std::int64_t largest = header_number(cursor, "largest value", most_value);
  const std::size_t count = image.width * image.height;
  image.value.reserve(std::min(count, file.bytes.size()));
  if (magic == "P2")
    read_text(cursor, largest, count, image.value);
  else
    read_binary(file, cursor.offset() + 1, largest, count, image.value);  // one blank, then the values
  return image;
}

}  // namespace io
