#pragma once
// A small writer of SVG pictures.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "geom/vec.h"

namespace io {

/// The data of a path: absolute moves, relative lines, coordinates on the grid of 10^-decimals. Differences
/// are taken between grid points, so that rounding does not add up along the path.
class SvgPath {
 public:
  explicit SvgPath(int decimals = 2);

  SvgPath& move_to(const geom::Vec2& p);
  SvgPath& line_to(const geom::Vec2& p);
  SvgPath& close();
  SvgPath& polygon(std::span<const geom::Vec2> corners);   ///< move, lines, close
  SvgPath& polyline(std::span<const geom::Vec2> corners);  ///< move, lines
  SvgPath& dot(const geom::Vec2& p);  ///< a line of no length: a disk with round line caps
  const std::string& data() const { return data_; }
  bool empty() const { return data_.empty(); }

 private:
  struct GridPoint {
    std::int64_t x = 0, y = 0;
  };
  GridPoint grid(const geom::Vec2& p) const;
  void append(GridPoint p, char command);

  int decimals_;
  double scale_;
  std::string data_;
  GridPoint at_, start_;
  char last_command_ = 0;
};

/// Coordinates in pixels, x to the right, y down. `attributes` is pasted as it is: R"(fill="#ccc")".
class Svg {
 public:
  Svg(double width, double height, int decimals = 2);

  void style(std::string_view css);
  void begin_group(std::string_view attributes);
  void end_group();

  void rectangle(const geom::Vec2& corner, const geom::Vec2& size, std::string_view attributes = {});
  void polygon(std::span<const geom::Vec2> corners, std::string_view attributes = {});
  void polyline(std::span<const geom::Vec2> corners, std::string_view attributes = {});
  void line(const geom::Vec2& from, const geom::Vec2& to, std::string_view attributes = {});
  void circle(const geom::Vec2& center, double radius, std::string_view attributes = {});
  void path(const SvgPath& path, std::string_view attributes = {});
  void text(const geom::Vec2& at, std::string_view words, std::string_view attributes = {});
  /// A PNG (png.h), stretched to the rectangle.
  void image(const geom::Vec2& corner, const geom::Vec2& size, std::string_view png,
             std::string_view attributes = {});

  /// The whole document; open groups are closed in it.
  std::string document() const;
  /// Writes it atomically (atomic_file.h).
  void save(const std::filesystem::path& file) const;

 private:
  void attribute(std::string_view name, double value);
  void begin(std::string_view element);
  void end(std::string_view attributes);

  int decimals_;
  int open_groups_ = 0;
  std::string text_;
};

}  // namespace io
