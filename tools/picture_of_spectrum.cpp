#include "tools/picture_of_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/chart.h"
#include "io/png.h"
#include "tools/worded.h"

namespace tools {
namespace {

using fpo::PowerSpectrum;
using geom::Vec2;

/// Pixels along a side of the gray picture.
constexpr int largest_side = 289;

/// How many neighbours along an axis become one pixel.
int block_size(const PowerSpectrum& s) { return 2 * std::max(s.half_x, s.half_y) / largest_side + 1; }

/// Of the frequencies around (block i, block j).
double block_mean(const PowerSpectrum& s, int i, int j, int block) {
  double sum = 0, count = 0;
  for (int b = 0; b < block; ++b) {
    for (int a = 0; a < block; ++a) {
      const int x = i * block + a - block / 2, y = j * block + b - block / 2;
      if (std::abs(x) > s.half_x || std::abs(y) > s.half_y) continue;
      sum += s.at(x, y);
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// A pixel is one or more frequencies; the middle one is frequency 0.
struct GrayPicture {
  int half_x, half_y;
  Vec2 reach;  ///< from the middle to the sides, in frequency
  std::string png;
};

GrayPicture gray_picture(const PowerSpectrum& s) {
  const int block = block_size(s), half_x = s.half_x / block, half_y = s.half_y / block;
  std::vector<std::uint8_t> pixels;
  for (int j = half_y; j >= -half_y; --j) {
    for (int i = -half_x; i <= half_x; ++i) {
      const double p = std::max(0.0, block_mean(s, i, j, block));
      pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * p / (1 + p))));
    }
  }
  const auto side = [](int half) { return static_cast<std::uint32_t>(2 * half + 1); };
  const Vec2 reach = block * s.step.cwiseProduct(Vec2(half_x + 0.5, half_y + 0.5));
  return {half_x, half_y, reach, io::gray_png(side(half_x), side(half_y), pixels)};
}

std::vector<Vec2> points(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < x.size(); ++i) result.emplace_back(x[i], y[i]);
  return result;
}

/// Makes an axis show at least that range.
io::Series invisible(double low, double high) { return {.points = {{0, low}, {0, high}}, .colour = "none"}; }

}  // namespace

SpectrumScale scale_of(std::span<const MeanSpectrum* const> spectra) {
  SpectrumScale scale;
  for (const MeanSpectrum* mean : spectra) {
    const double isotropic = 0 - fpo::decibel(static_cast<double>(mean->num_sets));
    if (scale.least_decibels == scale.most_decibels)
      scale.least_decibels = isotropic - 8, scale.most_decibels = isotropic + 8;
    for (const double power : mean->curve.mean)
      if (std::isfinite(power)) scale.most_power = std::max(scale.most_power, power);
    for (const double a : mean->curve.anisotropy) {
      const double decibels = fpo::decibel(a);
      if (!std::isfinite(decibels)) continue;
      scale.least_decibels = std::min(scale.least_decibels, decibels);
      scale.most_decibels = std::max(scale.most_decibels, decibels);
    }
  }
  return scale;
}

io::Svg draw_spectrum(const MeanSpectrum& mean, const SpectrumScale& scale) {
  const GrayPicture gray = gray_picture(mean.spectrum);
  const Vec2 size(820, 400);
  io::Svg svg(size.x(), size.y());
  io::add_chart_style(svg);
  svg.rectangle({0, 0}, size, "fill=\"#fff\"");

  io::Chart power;
  power.title = "Power spectrum";
  power.x = {.label = "frequency \u00d7 spacing", .low = -gray.reach.x(), .high = gray.reach.x()};
  power.y = {.label = "", .low = -gray.reach.y(), .high = gray.reach.y()};
  const io::PlotFrame frame = io::draw_chart(svg, power, {0, 0}, {396, 400});
  svg.image(frame.corner(), frame.size(), gray.png);
  svg.rectangle(frame.corner(), frame.size(), "class=\"frame\"");

  const io::Axis frequency{
      .label = "frequency \u00d7 spacing", .low = 0, .high = std::min(gray.reach.x(), gray.reach.y())};
  const std::string sets = std::to_string(mean.num_sets) + (mean.num_sets == 1 ? " set" : " sets");
  io::Chart radial;
  radial.title = "Radial mean, " + sets + " (white noise: 1)";
  radial.x = frequency;
  radial.x.label.clear();
  radial.y.label = "power";
  radial.guides.push_back({.y = 1});
  radial.series.push_back({.points = points(mean.curve.frequency, mean.curve.mean)});
  radial.series.push_back(invisible(0, scale.most_power));
  io::draw_chart(svg, radial, {400, 0}, {420, 200});

  const double isotropic = 0 - fpo::decibel(static_cast<double>(mean.num_sets));  // not -0
  io::Chart anisotropy;
  anisotropy.title = worded("Anisotropy (isotropic: %.1f dB)", isotropic);
  anisotropy.x = frequency;
  anisotropy.y.label = "dB";
  anisotropy.guides.push_back({.y = isotropic});
  std::vector<double> decibels;
  for (const double a : mean.curve.anisotropy) decibels.push_back(fpo::decibel(a));
  anisotropy.series.push_back({.points = points(mean.curve.frequency, decibels)});
  const bool own_range = scale.least_decibels == scale.most_decibels;
  anisotropy.series.push_back(own_range ? invisible(isotropic - 8, isotropic + 8)
                                        : invisible(scale.least_decibels, scale.most_decibels));
  io::draw_chart(svg, anisotropy, {400, 200}, {420, 200});
  return svg;
}

}  // namespace tools
