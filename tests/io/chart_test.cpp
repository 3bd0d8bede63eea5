#include "io/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using geom::Vec2;
using io::Axis;
using io::Series;

namespace {

/// The number that a label shows; its minus sign is U+2212.
double number(std::string label) {
  if (const auto minus = label.find("\u2212"); minus != label.npos) label.replace(minus, 3, "-");
  std::size_t used = 0;
  const double value = std::stod(label, &used);
  REQUIRE(used == label.size());
  return value;
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * d - x).norm();
}

double distance_to(const std::vector<std::vector<Vec2>>& parts, const Vec2& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts)
    for (std::size_t i = 0; i + 1 < part.size(); ++i)
      least = std::min(least, distance_to_segment(x, part[i], part[i + 1]));
  return least;
}

}  // namespace

TEST_CASE("axis_ticks: round, inside, even, few, and labelled with their values") {
  geom::Rng rng(3);
  for (int trial = 0; trial < 500; ++trial) {
    Axis axis;
    const double size = std::pow(10.0, rng.uniform(-6, 7));
    axis.low = trial % 3 == 0 ? 0 : rng.uniform(-3, 1) * size;
    axis.high = axis.low + rng.uniform(0.2, 4) * size;
    const int most = 2 + static_cast<int>(rng.below(9));
    CAPTURE(axis.low);
    CAPTURE(axis.high);
    CAPTURE(most);
    const auto ticks = io::axis_ticks(axis, most);
    REQUIRE(!ticks.empty());
    REQUIRE(ticks.size() <= static_cast<std::size_t>(most) + 1);
    if (most >= 5) REQUIRE(ticks.size() >= 2);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      REQUIRE(ticks[i].value >= axis.low - 1e-8 * size);
      REQUIRE(ticks[i].value <= axis.high + 1e-8 * size);
      const double step = i > 0 ? ticks[i].value - ticks[i - 1].value : size;
      REQUIRE(step > 0);
      REQUIRE(std::abs(number(ticks[i].label) - ticks[i].value) <= 0.01 * step);
      if (i > 0) {
        const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
        REQUIRE((std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 5) < 1e-6));
        if (i > 1) REQUIRE(step == doctest::Approx(ticks[i - 1].value - ticks[i - 2].value).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("axis_ticks: a logarithmic axis is ticked at 1, 2, 5 times powers of ten") {
  Axis axis{.label = "", .low = 0.002, .high = 300, .scale = Axis::Scale::logarithmic};
  for (const int most : {3, 6, 20}) {
    const auto ticks = io::axis_ticks(axis, most);
    REQUIRE(ticks.size() >= 2);
    REQUIRE(ticks.size() <= static_cast<std::size_t>(most) + 1);
    for (const io::Tick& tick : ticks) {
      const double digit = tick.value / std::pow(10.0, std::floor(std::log10(tick.value) + 1e-9));
      CHECK((std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 || std::abs(digit - 5) < 1e-9));
      CHECK(number(tick.label) == doctest::Approx(tick.value));
      CHECK((tick.value >= axis.low && tick.value <= axis.high));
    }
  }
}

TEST_CASE("axis_ticks: ranges that cannot be shown are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [low, high] : {std::pair{1.0, 1.0}, {2.0, 1.0}, {0.0, nan}, {-INFINITY, 0.0}})
    CHECK_THROWS_AS(io::axis_ticks({.label = "x", .low = low, .high = high}, 5), geom::InputError);
  CHECK_THROWS_AS(io::axis_ticks({.label = "x", .low = 0, .high = 1, .scale = Axis::Scale::logarithmic}, 5),
                  geom::InputError);
}

TEST_CASE("PlotFrame: corners of the ranges are corners of the frame; logarithms have equal ratios") {
  const io::PlotFrame frame({10, 20}, {100, 50}, {.label = "x", .low = -1, .high = 3},
                            {.label = "y", .low = 0.1, .high = 1000, .scale = Axis::Scale::logarithmic});
  CHECK((frame.pixel({-1, 0.1}) - Vec2(10, 70)).norm() < 1e-9);
  CHECK((frame.pixel({3, 1000}) - Vec2(110, 20)).norm() < 1e-9);
  const double step = frame.pixel({0, 1}).y() - frame.pixel({0, 10}).y();
  CHECK(step == doctest::Approx(12.5));
  CHECK(frame.pixel({0, 10}).y() - frame.pixel({0, 100}).y() == doctest::Approx(step));
  CHECK(!frame.pixel({0, 0}).allFinite());
  CHECK(!frame.pixel({0, -2}).allFinite());
}

TEST_CASE("PlotFrame: a clipped polyline is the part of it inside the frame") {
  const io::PlotFrame frame({0, 0}, {100, 80}, {.label = "", .low = 0, .high = 1},
                            {.label = "", .low = 0, .high = 1});
  geom::Rng rng(11);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec2> points;
    for (int i = 0; i < 12; ++i) points.emplace_back(rng.uniform(-0.5, 1.5), rng.uniform(-0.5, 1.5));
    if (trial % 2 == 0) points[5].y() = std::numeric_limits<double>::quiet_NaN();
    const auto parts = frame.visible_parts(points);
    std::vector<std::vector<Vec2>> whole;  // in pixels, unclipped
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (!points[i].allFinite() || !points[i + 1].allFinite()) continue;
      whole.push_back({frame.pixel(points[i]), frame.pixel(points[i + 1])});
      for (double t = 0; t <= 1; t += 0.05) {  // nothing visible is missing
        const Vec2 x = whole.back()[0] + t * (whole.back()[1] - whole.back()[0]);
        if (x.minCoeff() < 0 || x.x() > 100 || x.y() > 80) continue;
        REQUIRE(distance_to(parts, x) < 1e-9);
      }
    }
    for (const auto& part : parts) {  // nothing else is there
      REQUIRE(part.size() >= 2);
      for (std::size_t i = 0; i + 1 < part.size(); ++i) {
        for (const double t : {0.0, 0.5, 1.0}) {
          const Vec2 x = part[i] + t * (part[i + 1] - part[i]);
          REQUIRE(x.minCoeff() >= -1e-9);
          REQUIRE((x.x() <= 100 + 1e-9 && x.y() <= 80 + 1e-9));
          REQUIRE(distance_to(whole, x) < 1e-9);
        }
      }
    }
  }
}

TEST_CASE("draw_chart: an axis without a range holds all points") {
  io::Svg svg(400, 300);
  io::Chart chart;
  chart.series.push_back({.points = {{1, -0.3}, {40, 7.2}, {90, INFINITY}}});
  chart.series.push_back({.points = {{3, 0.001}, {100, 2}}});
  const io::PlotFrame linear = io::draw_chart(svg, chart, {0, 0}, {400, 300});
  CHECK((linear.x().low <= 1 && linear.x().high >= 100));
  CHECK((linear.y().low <= -0.3 && linear.y().high >= 7.2 && linear.y().high <= 10));
  chart.y.scale = Axis::Scale::logarithmic;
  const io::PlotFrame logarithmic = io::draw_chart(svg, chart, {0, 0}, {400, 300});
  CHECK((logarithmic.y().low == doctest::Approx(0.001) && logarithmic.y().high == doctest::Approx(10)));
  chart.series = {{.points = {{2, 5}}}};
  chart.y.scale = Axis::Scale::linear;
  const io::PlotFrame single = io::draw_chart(svg, chart, {0, 0}, {400, 300});
  CHECK((single.y().low < 5 && single.y().high > 5));
  chart.series.clear();
  CHECK_NOTHROW(io::draw_chart(svg, chart, {0, 0}, {400, 300}));
}

TEST_CASE("draw_chart: every series, name and guide is drawn once; text is escaped") {
  io::Chart chart{.title = "a < b",
                  .x = {.label = "time & more"},
                  .y = {.label = "y"},
                  .series = {},
                  .guides = {{.y = 1, .label = "one"}, {.y = 1e9, .label = "outside"}}};
  chart.series.push_back({.points = {{0, 0}, {1, 2}, {2, 1}}, .name = "curve", .dashed = true});
  chart.series.push_back({.points = {{0, 1}, {1, 3}, {2, 0}}, .style = Series::Style::bars});
  chart.series.push_back({.points = {{0.5, 0.5}, {1.5, NAN}}, .style = Series::Style::dots, .width = 4});
  const std::string text = io::draw_chart(chart).document();
  CHECK(count(text, "class=\"curve\"") == 2);
  CHECK(count(text, "class=\"bars\"") == 1);
  CHECK(count(text, "stroke-dasharray:5 4") == 1);
  CHECK(count(text, ">curve</text>") == 1);
  CHECK(count(text, ">one</text>") == 1);
  CHECK(count(text, "outside") == 0);
  CHECK(count(text, "a &lt; b") == 1);
  CHECK(count(text, "time &amp; more") == 1);
  CHECK(text.find("nan") == text.npos);
  CHECK(text.find("inf") == text.npos);
}

TEST_CASE("draw_chart: names of curves that end at one place stand apart") {
  for (const double end : {1.0, 5.0, 9.9}) {
    io::Chart chart;
    chart.x = {.label = "x", .low = 0, .high = 10};
    chart.y = {.label = "y", .low = 0, .high = 10};
    for (int i = 0; i < 5; ++i)
      chart.series.push_back({.points = {{0, 0}, {10, end + 0.01 * i}}, .name = "curve"});
    const std::string text = io::draw_chart(chart).document();
    std::vector<double> heights;
    for (std::size_t at = 0; (at = text.find("class=\"name\"", at)) != text.npos; ++at)
      heights.push_back(std::stod(text.substr(text.rfind("y=\"", at) + 3)));
    std::ranges::sort(heights);
    REQUIRE(heights.size() == 5);
    for (std::size_t i = 1; i < 5; ++i) CHECK(heights[i] - heights[i - 1] >= 11.9);
  }
}

TEST_CASE("draw_chart: the area of a histogram's bars is the sum of their heights") {
  io::Chart chart;
  chart.x = {.label = "x", .low = 0, .high = 4};
  chart.y = {.label = "y", .low = 0, .high = 10};
  chart.series.push_back({.points = {{0, 3}, {1, 0}, {2, 8}, {3, 5}, {4, 0}}, .style = Series::Style::bars});
  io::Svg svg(500, 400, 4);
  const io::PlotFrame frame = io::draw_chart(svg, chart, {0, 0}, {500, 400});
  const std::string text = svg.document();
  const std::size_t at = text.find("d=\"");
  REQUIRE(at != text.npos);
  // M x y then relative lines, closed: shoelace over the path's subpaths.
  double area = 0;
  const char* s = text.c_str() + at + 3;
  Vec2 p(0, 0);
  std::vector<Vec2> corners;
  while (*s != '"') {
    if (*s == 'z') {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        area += 0.5 * (a.x() * b.y() - a.y() * b.x());
      }
      ++s;
      continue;
    }
    const bool absolute = *s == 'M';
    if (*s == 'M' || *s == 'l') ++s;
    char* end = nullptr;
    const double x = std::strtod(s, &end), y = std::strtod(end, &end);
    REQUIRE(end != s);
    s = end;
    if (absolute) {
      corners.clear();
      p = {x, y};
    } else {
      p += Vec2(x, y);
    }
    corners.push_back(p);
  }
  const double unit = frame.size().x() / 4 * frame.size().y() / 10;
  CHECK(std::abs(area) == doctest::Approx(16 * unit).epsilon(1e-3));
}
