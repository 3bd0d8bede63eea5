#pragma once
// Line plots with axes: curves, dots and histograms on top of svg.h.

#include <string>
#include <vector>

#include "geom/vec.h"
#include "io/svg.h"

namespace io {

struct Axis {
  enum class Scale { linear, logarithmic };

  std::string label;
  double low = 0, high = 0;  ///< the range shown; equal: as far as the series reach, rounded up to ticks
  Scale scale = Scale::linear;
};

struct Tick {
  double value = 0;
  std::string label;
};

/// At most about `most` round values in [low, high] (1, 2 or 5 times a power of ten apart; on a logarithmic
/// axis the powers of ten, with 2 and 5 times them where few powers fit), labelled in as few digits as tell
/// them apart. Throws geom::InputError unless low < high are finite, and positive on a logarithmic axis.
std::vector<Tick> axis_ticks(const Axis& axis, int most);

struct Series {
  enum class Style { line, dots, bars };

  /// Ascending x for lines. A point that is not finite, or not positive on a logarithmic axis, breaks a line
  /// and is left out otherwise. A bar reaches from its point to that of the next bar and from the y axis's
  /// low end up: the last point only ends its predecessor's bar.
  std::vector<geom::Vec2> points;
  std::string name = {};  ///< written beside the curve's last visible point; empty: nothing
  Style style = Style::line;
  std::string colour = "#1d4f91";  ///< as in CSS
  double width = 1.6;              ///< of a line or the diameter of dots, pixels
  bool dashed = false;
};

/// A horizontal thin line across the plot, for a value to compare with.
struct Guide {
  double y = 0;
  std::string label = {};  ///< written above its right end
};

struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  std::vector<Guide> guides;
};

/// A rectangle of the picture and the ranges that its sides stand for.
class PlotFrame {
 public:
  /// Ranges must not be empty. Throws geom::InputError as axis_ticks() does.
  PlotFrame(const geom::Vec2& corner, const geom::Vec2& size, Axis x, Axis y);

  geom::Vec2 corner() const { return corner_; }
  geom::Vec2 size() const { return size_; }
  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }
  /// Pixels of a point; not finite where a logarithmic axis has no place for it.
  geom::Vec2 pixel(const geom::Vec2& value) const;
  /// Border, ticks outside of it with their labels, names of the axes. Labels take about 45 pixels on the
  /// left and 40 below.
  void draw_axes(Svg& svg) const;
  /// The parts of a polyline (in values) inside the frame, in pixels.
  std::vector<std::vector<geom::Vec2>> visible_parts(const std::vector<geom::Vec2>& points) const;

 private:
  geom::Vec2 corner_, size_;
  Axis x_, y_;
};

/// The style that charts rely on; once a document, before the first chart.
void add_chart_style(Svg& svg);

/// Draws a chart into a rectangle of a picture, labels included; returns the frame, to draw more into. Series
/// are clipped to the frame. Throws geom::InputError on a range that cannot be shown. Cost: linear.
PlotFrame draw_chart(Svg& svg, const Chart& chart, const geom::Vec2& corner, const geom::Vec2& size);

/// The chart as a picture of its own.
Svg draw_chart(const Chart& chart, const geom::Vec2& size = {480, 320});

}  // namespace io
