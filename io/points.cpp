#include "io/points.h"

#include <algorithm>
#include <array>
#include <string>

#include "geom/check.h"
#include "io/atomic_file.h"
#include "io/extension.h"
#include "io/input_file.h"
#include "io/numbers.h"
#include "io/ply.h"
#include "io/text_cursor.h"

namespace io {

using geom::WeightedPoint2;
using geom::WeightedPoint3;

namespace {

[[noreturn]] void fail_dimension(const std::filesystem::path& path, const char* dimension,
                                 const char* formats) {
  throw geom::InputError(display_name(path) + ": points " + dimension + " are kept in " + formats);
}

/// Lines of `dimension` coordinates and perhaps a weight.
template <int dimension>
auto parse_lines(const InputFile& file) {
  using Point = std::conditional_t<dimension == 2, WeightedPoint2, WeightedPoint3>;
  std::vector<Point> points;
  TextCursor cursor(file);
  while (cursor.next_line()) {
    Point& point = points.emplace_back();
    for (double& x : point.position) x = cursor.coordinate(cursor.word());
    if (const auto weight = cursor.word(); !weight.empty()) point.weight = cursor.coordinate(weight);
    if (const auto extra = cursor.word(); !extra.empty())
      cursor.fail(in_quotes(extra) + " after " + std::to_string(dimension) + " coordinates and a weight");
  }
  return points;
}

template <class Point>
std::string to_lines(const std::vector<Point>& points) {
  const bool weights =
      std::any_of(points.begin(), points.end(), [](const Point& p) { return p.weight != 0; });
  std::string text;
  for (const Point& point : points) {
    const char* separator = "";
    for (const double x : point.position) {
      append_shortest(text += separator, x);
      separator = " ";
    }
    if (weights) append_shortest(text += ' ', point.weight);
    text += '\n';
  }
  return text;
}

}  // namespace

PointFormat point_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".xyz") return PointFormat::xyz;
  if (extension == ".txt") return PointFormat::txt;
  if (extension == ".ply") return PointFormat::ply;
  fail_extension(path, "points are .xyz, .ply or .txt");
}

std::vector<WeightedPoint3> read_points3(const std::filesystem::path& path) {
  const InputFile file = load(path);
  const PointFormat format = point_format(path);
  if (format == PointFormat::txt) fail_dimension(path, "in space", ".xyz or .ply");
  auto points = format == PointFormat::ply ? parse_ply_points(file) : parse_lines<3>(file);
  if (points.empty()) file.fail("no points");
  return points;
}

std::vector<WeightedPoint2> read_points2(const std::filesystem::path& path) {
  const InputFile file = load(path);
  if (point_format(path) != PointFormat::txt) fail_dimension(path, "in the plane", ".txt");
  auto points = parse_lines<2>(file);
  if (points.empty()) file.fail("no points");
  return points;
}

void write_points(const std::filesystem::path& path, const std::vector<WeightedPoint3>& points) {
  const PointFormat format = point_format(path);
  if (format == PointFormat::txt) fail_dimension(path, "in space", ".xyz or .ply");
  write_file(path, format == PointFormat::ply ? to_ply(points) : to_lines(points));
}

void write_points(const std::filesystem::path& path, const std::vector<WeightedPoint2>& points) {
  if (point_format(path) != PointFormat::txt) fail_dimension(path, "in the plane", ".txt");
  write_file(path, to_lines(points));
}

}  // namespace io
