#include "io/polylines.h"

#include <string>

#include "io/input_file.h"
#include "io/text_cursor.h"

namespace io {

std::vector<std::vector<geom::Vec2>> read_polylines(const std::filesystem::path& path) {
  const InputFile file = load(path);
  std::vector<std::vector<geom::Vec2>> polylines;
  TextCursor cursor(file);
  for (std::size_t last = 0; cursor.next_line(); last = cursor.line()) {
    if (polylines.empty() || cursor.line() > last + 1) polylines.emplace_back();
    geom::Vec2& corner = polylines.back().emplace_back();
    for (double& x : corner) x = cursor.coordinate(cursor.word());
    if (const auto extra = cursor.word(); !extra.empty()) cursor.fail(in_quotes(extra) + " after x and y");
  }
  if (polylines.empty()) file.fail("no points");
  return polylines;
}

}  // namespace io
