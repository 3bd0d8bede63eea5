#include "io/chart.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geom/check.h"
#include "io/numbers.h"

namespace io {

using geom::Vec2;

namespace {

constexpr double margin_left = 52, margin_right = 14, margin_above = 26, margin_below = 44;
constexpr double tick_length = 4;

/// A decimal number with a true minus sign.
std::string label_of(double value, int decimals) {
  char digits[400];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, std::abs(value), std::chars_format::fixed, decimals).ptr;
  return (value < 0 ? "\u2212" : "") + std::string(digits, end);
}

/// Numbers too long to be written out, and powers of ten.
std::string short_label(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  if (exponent >= -3 && exponent <= 4) return label_of(value, std::max(0, -exponent));
  const double digit = value / std::pow(10.0, exponent);
  std::string text = label_of(digit, std::abs(digit - std::round(digit)) < 1e-9 ? 0 : 2);
  text += "e";
  append_integer(text, exponent);
  return text;
}

/// The round step that divides a length into at most `most` parts.
double round_step(double length, int most) {
  const double least = length / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<Tick> linear_ticks(const Axis& axis, int most) {
  const double step = round_step(axis.high - axis.low, most);
  const int exponent = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  const bool written_out = largest < 1e5 && exponent >= -5;
  std::vector<Tick> ticks;
  const double slack = 1e-9 * step;
  for (double k = std::ceil((axis.low - slack) / step); k * step <= axis.high + slack; ++k) {
    const double value = k == 0 ? 0 : k * step;  // no -0
    const bool plain = written_out || value == 0;
    ticks.push_back({value, plain ? label_of(value, std::max(0, -exponent)) : short_label(value)});
  }
  return ticks;
}

std::vector<Tick> logarithmic_ticks(const Axis& axis, int most) {
  const double decades = std::log10(axis.high / axis.low);
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / most)));
  const bool between = 3 * decades <= most;
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(axis.low)));
  for (int e = first; e <= std::log10(axis.high) + 1e-9; ++e) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, e);
      if (factor != 1 && !between) break;
      if (factor == 1 && e % stride != 0) continue;
      if (value < axis.low * (1 - 1e-9) || value > axis.high * (1 + 1e-9)) continue;
      ticks.push_back({value, short_label(value)});
    }
  }
  return ticks;
}

bool is_log(const Axis& axis) { return axis.scale == Axis::Scale::logarithmic; }

/// A coordinate as the axis counts it: a logarithm is not finite where there is none.
double position(const Axis& axis, double value) { return is_log(axis) ? std::log10(value) : value; }

/// The share of the axis that lies before a value.
double share(const Axis& axis, double value) {
  const double low = position(axis, axis.low), high = position(axis, axis.high);
  return (position(axis, value) - low) / (high - low);
}

void require_range(const Axis& axis) {
  geom::require(std::isfinite(axis.low) && std::isfinite(axis.high) && axis.low < axis.high,
                "a chart's axis '" + axis.label + "' has no range");
  geom::require(!is_log(axis) || axis.low > 0,
                "the logarithmic axis '" + axis.label + "' must begin above 0");
}

/// An axis without a range gets one that holds all points, ending at ticks.
Axis fitted(Axis axis, const std::vector<Series>& series, Eigen::Index coordinate) {
  if (axis.low != axis.high) return axis;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series& s : series) {
    for (const Vec2& p : s.points) {
      const double value = p[coordinate];
      if (!std::isfinite(position(axis, value))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) low = is_log(axis) ? 1 : 0, high = 1;
  if (is_log(axis)) {
    axis.low = std::pow(10.0, std::floor(std::log10(low) + 1e-9));
    axis.high = std::max(10 * axis.low, std::pow(10.0, std::ceil(std::log10(high) - 1e-9)));
    return axis;
  }
  if (low == high) {
    const double around = low == 0 ? 1 : std::abs(low) / 2;
    low -= around;
    high += around;
  }
  const double step = round_step(high - low, coordinate == 0 ? 8 : 6);
  axis.low = coordinate == 0 ? low : step * std::floor(low / step + 1e-9);
  axis.high = coordinate == 0 ? high : step * std::ceil(high / step - 1e-9);
  return axis;
}

/// The part of segment ab inside the box [corner, corner + size] (Liang, Barsky), if any.
std::optional<std::array<Vec2, 2>> clipped(const Vec2& a, const Vec2& b, const Vec2& corner,
                                           const Vec2& size) {
  double from = 0, to = 1;
  const Vec2 d = b - a;
  for (Eigen::Index k = 0; k < 2; ++k) {
    for (const double side : {-1.0, 1.0}) {
      const double inside = side < 0 ? a[k] - corner[k] : corner[k] + size[k] - a[k];
      const double outwards = side * d[k];
      if (outwards == 0 && inside < 0) return std::nullopt;
      if (outwards > 0) to = std::min(to, inside / outwards);
      if (outwards < 0) from = std::max(from, inside / outwards);
    }
  }
  if (from > to) return std::nullopt;
  return std::array<Vec2, 2>{from == 0 ? a : Vec2(a + from * d), to == 1 ? b : Vec2(a + to * d)};
}

std::string stroke(const Series& series) {
  std::string attributes = "class=\"curve\" style=\"stroke:" + series.colour + ";stroke-width:";
  append_rounded(attributes, series.width, 2);
  if (series.dashed) attributes += ";stroke-dasharray:5 4";
  return attributes + "\"";
}

std::string fill(const Series& series) { return "style=\"fill:" + series.colour + "\""; }

/// Writes a curve's name above and left of one of its points, inside the frame, and so far above (else below)
/// the names that are there already that both can be read.
void write_name(Svg& svg, const PlotFrame& frame, const Series& series, const Vec2& at,
                std::vector<Vec2>& names) {
  if (series.name.empty()) return;
  constexpr double line = 12, width = 120;
  const double highest = frame.corner().y() + line;
  Vec2 place(std::min(at.x(), frame.corner().x() + frame.size().x() - 4), std::max(at.y() - 6, highest));
  const auto covers_a_name = [&] {
    return std::ranges::any_of(names, [&](const Vec2& other) {
      return std::abs(other.x() - place.x()) < width && std::abs(other.y() - place.y()) < line;
    });
  };
  const double wanted = place.y();
  while (covers_a_name() && place.y() - 1 >= highest) place.y() -= 1;
  if (covers_a_name()) place.y() = wanted;
  while (covers_a_name()) place.y() += 1;
  names.push_back(place);
  svg.text(place, series.name, "class=\"name\" text-anchor=\"end\" " + fill(series));
}

std::optional<Vec2> draw_line(Svg& svg, const PlotFrame& frame, const Series& series) {
  SvgPath path;
  std::optional<Vec2> last;
  for (const std::vector<Vec2>& part : frame.visible_parts(series.points)) {
    path.polyline(part);
    last = part.back();
  }
  if (!path.empty()) svg.path(path, stroke(series));
  return last;
}

std::optional<Vec2> draw_dots(Svg& svg, const PlotFrame& frame, const Series& series) {
  SvgPath path;
  std::optional<Vec2> last;
  for (const Vec2& value : series.points) {
    const Vec2 p = frame.pixel(value), within = (p - frame.corner()).cwiseQuotient(frame.size());
    if (!(within.minCoeff() >= 0 && within.maxCoeff() <= 1)) continue;  // also false for NaN
    path.dot(p);
    last = p;
  }
  if (!path.empty()) svg.path(path, stroke(series));
  return last;
}

std::optional<Vec2> draw_bars(Svg& svg, const PlotFrame& frame, const Series& series) {
  SvgPath path;
  std::optional<Vec2> last;
  const Vec2 low = frame.corner(), high = frame.corner() + frame.size();
  for (std::size_t i = 0; i + 1 < series.points.size(); ++i) {
    const Vec2 left = frame.pixel(series.points[i]), right = frame.pixel(series.points[i + 1]);
    if (!left.allFinite() || !std::isfinite(right.x())) continue;
    const double x0 = std::max(left.x(), low.x()), x1 = std::min(right.x(), high.x());
    const double y = std::clamp(left.y(), low.y(), high.y());
    if (x0 >= x1 || y == high.y()) continue;
    path.polygon(std::array<Vec2, 4>{Vec2(x0, high.y()), Vec2(x0, y), Vec2(x1, y), Vec2(x1, high.y())});
    last = Vec2(x1, y);
  }
  if (!path.empty()) svg.path(path, "class=\"bars\" " + fill(series));
  return last;
}

void draw_guide(Svg& svg, const PlotFrame& frame, const Guide& guide) {
  const double y = frame.pixel({frame.x().high, guide.y}).y();
  const double left = frame.corner().x(), right = left + frame.size().x();
  if (!(y >= frame.corner().y() && y <= frame.corner().y() + frame.size().y())) return;
  svg.line({left, y}, {right, y}, "class=\"guide\"");
  if (!guide.label.empty())
    svg.text({right - 4, y - 4}, guide.label, "class=\"guide-label\" text-anchor=\"end\"");
}

}  // namespace

std::vector<Tick> axis_ticks(const Axis& axis, int most) {
  require_range(axis);
  most = std::max(most, 1);
  return is_log(axis) ? logarithmic_ticks(axis, most) : linear_ticks(axis, most);
}

PlotFrame::PlotFrame(const Vec2& corner, const Vec2& size, Axis x, Axis y)
    : corner_(corner), size_(size), x_(std::move(x)), y_(std::move(y)) {
  require_range(x_);
  require_range(y_);
}

Vec2 PlotFrame::pixel(const Vec2& value) const {
  return corner_ + Vec2(share(x_, value.x()) * size_.x(), (1 - share(y_, value.y())) * size_.y());
}

void PlotFrame::draw_axes(Svg& svg) const {
  const double left = corner_.x(), bottom = corner_.y() + size_.y();
  for (const Tick& tick : axis_ticks(x_, static_cast<int>(size_.x() / 45))) {
    const double at = pixel({tick.value, y_.low}).x();
    svg.line({at, bottom}, {at, bottom + tick_length}, "class=\"axis\"");
    svg.text({at, bottom + tick_length + 12}, tick.label, "class=\"tick\" text-anchor=\"middle\"");
  }
  for (const Tick& tick : axis_ticks(y_, static_cast<int>(size_.y() / 28))) {
    const double at = pixel({x_.low, tick.value}).y();
    svg.line({left - tick_length, at}, {left, at}, "class=\"axis\"");
    svg.text({left - tick_length - 4, at + 4}, tick.label, "class=\"tick\" text-anchor=\"end\"");
  }
  svg.rectangle(corner_, size_, "class=\"frame\"");
  svg.text({left + size_.x() / 2, bottom + 36}, x_.label, "class=\"label\" text-anchor=\"middle\"");
  std::string turn = "class=\"label\" text-anchor=\"middle\" transform=\"rotate(-90 ";
  append_rounded(turn, left - 38, 2);
  append_rounded(turn += ' ', corner_.y() + size_.y() / 2, 2);
  svg.text({left - 38, corner_.y() + size_.y() / 2}, y_.label, turn + ")\"");
}

std::vector<std::vector<Vec2>> PlotFrame::visible_parts(const std::vector<Vec2>& points) const {
  std::vector<std::vector<Vec2>> parts;
  bool joined = false;  // the last part ends where the next segment begins
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 a = pixel(points[i]), b = pixel(points[i + 1]);
    const bool whole = a.allFinite() && b.allFinite();
    const auto piece = whole ? clipped(a, b, corner_, size_) : std::nullopt;
    if (!piece) {
      joined = false;
      continue;
    }
    if (!joined) parts.push_back({(*piece)[0]});
    parts.back().push_back((*piece)[1]);
    joined = (*piece)[1] == b;
  }
  return parts;
}

void add_chart_style(Svg& svg) {
  svg.style(
      "text{font-family:Helvetica,Arial,sans-serif;fill:#333}.tick{font-size:11px}.label{font-size:12px}"
      ".title{font-size:13px;font-weight:bold;fill:#111}.name{font-size:11px}"
      ".guide-label{font-size:11px;fill:#888}.frame{fill:none;stroke:#333;stroke-width:1}"
      ".axis{stroke:#333;stroke-width:1}.guide{stroke:#aaa;stroke-width:1;stroke-dasharray:3 3}"
      ".curve{fill:none;stroke-linejoin:round;stroke-linecap:round}.bars{fill-opacity:.75}");
}

PlotFrame draw_chart(Svg& svg, const Chart& chart, const Vec2& corner, const Vec2& size) {
  const Vec2 inner_corner = corner + Vec2(margin_left, chart.title.empty() ? 8 : margin_above);
  const Vec2 inner_size = corner + size - Vec2(margin_right, margin_below) - inner_corner;
  const PlotFrame frame(inner_corner, inner_size, fitted(chart.x, chart.series, 0),
                        fitted(chart.y, chart.series, 1));
  if (!chart.title.empty())
    svg.text({inner_corner.x(), inner_corner.y() - 9}, chart.title, "class=\"title\"");
  for (const Guide& guide : chart.guides) draw_guide(svg, frame, guide);
  std::vector<std::optional<Vec2>> ends;
  for (const Series& series : chart.series) {
    switch (series.style) {
      case Series::Style::line:
        ends.push_back(draw_line(svg, frame, series));
        break;
      case Series::Style::dots:
        ends.push_back(draw_dots(svg, frame, series));
        break;
      case Series::Style::bars:
        ends.push_back(draw_bars(svg, frame, series));
        break;
    }
  }
  std::vector<Vec2> names;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends[i]) write_name(svg, frame, chart.series[i], *ends[i], names);
  frame.draw_axes(svg);
  return frame;
}

Svg draw_chart(const Chart& chart, const Vec2& size) {
  Svg svg(size.x(), size.y());
  add_chart_style(svg);
  svg.rectangle({0, 0}, size, "fill=\"#fff\"");
  draw_chart(svg, chart, {0, 0}, size);
  return svg;
}

}  // namespace io
