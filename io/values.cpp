#include "io/values.h"

#include <string>

#include "io/atomic_file.h"
#include "io/input_file.h"
#include "io/numbers.h"
#include "io/text_cursor.h"

namespace io {

std::vector<double> read_positive_values(const std::filesystem::path& path, std::size_t count) {
  const InputFile file = load(path);
  TextCursor cursor(file);
  std::vector<double> values;
  while (cursor.next_line()) {
    const std::string_view word = cursor.word();
    const double value = parse_real(word).value_or(-1);
    if (!(value > 0)) cursor.fail(in_quotes(word) + " is not a positive number");
    if (value > largest_coordinate) cursor.fail(in_quotes(word) + " is beyond 1e48");
    if (!cursor.word().empty()) cursor.fail("more than one number");
    if (values.size() == count) cursor.fail("more than " + std::to_string(count) + " numbers");
    values.push_back(value);
  }
  if (values.size() != count)
    file.fail(std::to_string(values.size()) + " numbers where " + std::to_string(count) + " are wanted");
  return values;
}

void write_values(const std::filesystem::path& path, std::span<const double> values) {
  std::string text;
  for (const double value : values) {
    append_shortest(text, value);
    text += '\n';
  }
  write_file(path, text);
}

}  // namespace io
