#include "io/svg.h"

#include <cmath>

#include "geom/check.h"
#include "io/atomic_file.h"
#include "io/markup.h"
#include "io/numbers.h"
#include "io/png.h"

namespace io {

using geom::Vec2;

SvgPath::SvgPath(int decimals) : decimals_(decimals), scale_(std::pow(10.0, decimals)) {}

SvgPath::GridPoint SvgPath::grid(const Vec2& p) const {
  return {std::llround(p.x() * scale_), std::llround(p.y() * scale_)};
}

/// A repeated command is left out, and so is a blank that the next number's sign makes needless.
void SvgPath::append(GridPoint p, char command) {
  const bool repeated = command == 'l' && last_command_ == 'l';
  if (!repeated) data_ += command;
  const std::size_t begin = data_.size();
  append_rounded(data_, static_cast<double>(p.x) / scale_, decimals_);
  if (repeated && data_[begin] != '-') data_.insert(begin, 1, ' ');
  const std::size_t middle = data_.size();
  append_rounded(data_, static_cast<double>(p.y) / scale_, decimals_);
  if (data_[middle] != '-') data_.insert(middle, 1, ' ');
  last_command_ = command;
}

SvgPath& SvgPath::move_to(const Vec2& p) {
  at_ = start_ = grid(p);
  append(at_, 'M');
  return *this;
}

SvgPath& SvgPath::line_to(const Vec2& p) {
  const GridPoint to = grid(p);
  append({to.x - at_.x, to.y - at_.y}, 'l');
  at_ = to;
  return *this;
}

SvgPath& SvgPath::close() {
  data_ += 'z';
  last_command_ = 'z';
  at_ = start_;
  return *this;
}

SvgPath& SvgPath::polyline(std::span<const Vec2> corners) {
  if (corners.empty()) return *this;
  move_to(corners[0]);
  for (const Vec2& p : corners.subspan(1)) line_to(p);
  return *this;
}

SvgPath& SvgPath::polygon(std::span<const Vec2> corners) {
  return corners.empty() ? *this : polyline(corners).close();
}

SvgPath& SvgPath::dot(const Vec2& p) {
  move_to(p);
  data_ += "h0";
  last_command_ = 'h';
  return *this;
}

Svg::Svg(double width, double height, int decimals)
    : decimals_(decimals), text_(R"(<svg xmlns="http://www.w3.org/2000/svg")") {
  attribute("width", width);
  attribute("height", height);
  text_ += " viewBox=\"0 0 ";
  append_rounded(text_, width, decimals_);
  append_rounded(text_ += ' ', height, decimals_);
  text_ += "\">\n";
}

void Svg::attribute(std::string_view name, double value) {
  text_ += ' ';
  text_ += name;
  text_ += "=\"";
  append_rounded(text_, value, decimals_);
  text_ += '"';
}

void Svg::begin(std::string_view element) {
  text_ += '<';
  text_ += element;
}

void Svg::end(std::string_view attributes) {
  if (!attributes.empty()) (text_ += ' ') += attributes;
  text_ += "/>\n";
}

void Svg::style(std::string_view css) { ((text_ += "<style>") += css) += "</style>\n"; }

void Svg::begin_group(std::string_view attributes) {
  text_ += "<g";
  if (!attributes.empty()) (text_ += ' ') += attributes;
  text_ += ">\n";
  ++open_groups_;
}

void Svg::end_group() {
  geom::ensure(open_groups_ > 0, "Svg: end_group without begin_group");
  text_ += "</g>\n";
  --open_groups_;
}

void Svg::rectangle(const Vec2& corner, const Vec2& size, std::string_view attributes) {
  begin("rect");
  attribute("x", corner.x());
  attribute("y", corner.y());
  attribute("width", size.x());
  attribute("height", size.y());
  end(attributes);
}

void Svg::image(const Vec2& corner, const Vec2& size, std::string_view png, std::string_view attributes) {
  begin("image");
  attribute("x", corner.x());
  attribute("y", corner.y());
  attribute("width", size.x());
  attribute("height", size.y());
  text_ += " preserveAspectRatio=\"none\" href=\"data:image/png;base64," + base64(png) + "\"";
  end(attributes);
}

void Svg::polygon(std::span<const Vec2> corners, std::string_view attributes) {
  path(SvgPath(decimals_).polygon(corners), attributes);
}

void Svg::polyline(std::span<const Vec2> corners, std::string_view attributes) {
  path(SvgPath(decimals_).polyline(corners), attributes);
}

void Svg::line(const Vec2& from, const Vec2& to, std::string_view attributes) {
  begin("line");
  attribute("x1", from.x());
  attribute("y1", from.y());
  attribute("x2", to.x());
  attribute("y2", to.y());
  end(attributes);
}

void Svg::circle(const Vec2& center, double radius, std::string_view attributes) {
  begin("circle");
  attribute("cx", center.x());
  attribute("cy", center.y());
  attribute("r", radius);
  end(attributes);
}

void Svg::path(const SvgPath& path, std::string_view attributes) {
  begin("path");
  ((text_ += " d=\"") += path.data()) += '"';
  end(attributes);
}

void Svg::text(const Vec2& at, std::string_view words, std::string_view attributes) {
  begin("text");
  attribute("x", at.x());
  attribute("y", at.y());
  if (!attributes.empty()) (text_ += ' ') += attributes;
  ((text_ += '>') += escaped(words)) += "</text>\n";
}

std::string Svg::document() const {
  std::string whole = text_;
  for (int i = 0; i < open_groups_; ++i) whole += "</g>\n";
  return whole + "</svg>\n";
}

void Svg::save(const std::filesystem::path& file) const { write_file(file, document()); }

}  // namespace io
