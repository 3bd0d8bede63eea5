#include "io/html_report.h"

#include "geom/check.h"
#include "io/atomic_file.h"
#include "io/markup.h"
#include "io/numbers.h"
#include "io/png.h"
#include "io/report_assets.h"

namespace io {

using geom::Vec3;

namespace {

std::string element(const char* name, std::string_view attributes, const std::string& content) {
  std::string result = std::string("<") + name;
  if (!attributes.empty()) (result += ' ') += attributes;
  return result + ">" + content + "</" + name + ">\n";
}

std::string row(const HtmlTable::Row& row, const char* cell, bool words) {
  std::string cells;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const HtmlTable::Mark mark = row.marks.empty() ? HtmlTable::Mark::none : row.marks[i];
    const char* look = words && i > 0                  ? "class=\"words\""
                       : mark == HtmlTable::Mark::bold ? "class=\"best\""
                       : mark == HtmlTable::Mark::gray ? "class=\"gray\""
                                                       : "";
    cells += element(cell, look, escaped(row.cells[i]));
    cells.pop_back();
  }
  return element("tr", row.own ? "class=\"own\"" : row.quiet ? "class=\"quiet\"" : "", cells);
}

/// Rows right, up and towards the viewer, as numbers one after the other.
std::string rotation_json(const SceneView& view) {
  const Vec3 toward = view.towards_viewer.normalized();
  const Vec3 across = view.up.cross(toward);
  geom::require(across.norm() > 1e-6 * view.up.norm(), "the view direction and 'up' must span a plane");
  const Vec3 right = across.normalized(), up = toward.cross(right);
  std::string numbers;
  for (const Vec3& axis : {right, up, toward}) {
    for (int k = 0; k < 3; ++k) {
      numbers += numbers.empty() ? "[" : ",";
      append_shortest(numbers, axis[k]);
    }
  }
  return "{\"rotation\":" + numbers + "]}";
}

std::string scale_bar(const SceneScale& scale) {
  if (scale.colours.empty()) return "";
  std::string stops, labels;
  for (const Colour colour : scale.colours) stops += "," + css(colour);
  for (const std::string& label : scale.labels) {
    labels += element("span", "", escaped(label));
    labels.pop_back();
  }
  const std::string bar =
      element("div", "class=\"bar\" style=\"background: linear-gradient(to right" + stops + ")\"", "");
  return element("div", "class=\"scale\"", "\n" + bar + element("div", "class=\"labels\"", labels));
}

std::string json_block(std::string_view attributes, std::string_view json) {
  geom::ensure(json.find("</") == std::string_view::npos, "JSON in a page must not contain </");
  return element("script", "type=\"application/json\" " + std::string(attributes), std::string(json));
}

}  // namespace

HtmlReport::HtmlReport(std::string_view title) : title_(escaped(title)) { body_ = element("h1", "", title_); }

void HtmlReport::heading(std::string_view text) { body_ += element("h2", "", escaped(text)); }

void HtmlReport::paragraph(std::string_view text) { body_ += element("p", "", escaped(text)); }

void HtmlReport::banner(std::string_view text) { body_ += element("p", "class=\"banner\"", escaped(text)); }

void HtmlReport::note(std::string_view text) { body_ += element("p", "class=\"note\"", escaped(text)); }

void HtmlReport::command(std::string_view text) {
  std::string code = element("code", "", escaped(text));
  code.pop_back();
  body_ += element("p", "", code);
}

void HtmlReport::table(const HtmlTable& table) {
  std::string content;
  if (!table.head.empty()) content += element("thead", "", row({table.head}, "th", table.words));
  std::string rows;
  for (const HtmlTable::Row& r : table.rows) rows += row(r, "td", table.words);
  content += element("tbody", "", "\n" + rows);
  body_ += element("div", "class=\"tablebox\"", element("table", "", "\n" + content));
}

void HtmlReport::folded(std::string_view line, const HtmlTable& table_inside) {
  const std::string before = std::move(body_);
  body_.clear();
  table(table_inside);
  body_ = before + element("details", "", element("summary", "", escaped(line)) + body_);
}

void HtmlReport::plots(std::span<const HtmlPlot> plots) {
  std::string figures;
  for (const HtmlPlot& plot : plots) {
    std::string content = "\n" + plot.svg.document();
    if (!plot.caption.empty()) content += element("figcaption", "", escaped(plot.caption));
    figures += element("figure", "class=\"plot\"", content);
  }
  body_ += element("div", "class=\"plots\"", "\n" + figures);
}

void HtmlReport::scenes(std::span<const Scene> scenes, const SceneView& view, const Svg& still) {
  geom::ensure(!has_scenes_, "a page has its scenes in one place");
  has_scenes_ = true;
  std::string figures;
  for (const Scene& scene : scenes) {
    const std::string caption =
        "<b>" + escaped(scene.title) + "</b> " + escaped(scene.note) + scale_bar(scene.scale);
    figures +=
        element("figure", "class=\"scene\"",
                "\n" + element("figcaption", "", caption) + json_block("class=\"scene\"", scene_json(scene)));
  }
  body_ += element("div", "class=\"scenes\"", "\n" + figures);
  body_ += json_block("id=\"view\"", rotation_json(view));
  body_ += element(
      "noscript", "",
      "<img alt=\"" + title_ + "\" src=\"data:image/svg+xml;base64," + base64(still.document()) + "\"/>");
}

void HtmlReport::data(std::string_view id, std::string_view json) {
  body_ += json_block("id=\"" + escaped(id) + "\"", json);
}

std::string HtmlReport::document() const {
  std::string head = "<meta charset=\"utf-8\"/>\n";
  head +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
  head += element("title", "", title_);
  head += element("style", "", "\n" + std::string(report_style()));
  std::string body = body_;
  if (has_scenes_) body += element("script", "", "\n" + std::string(report_script()));
  return "<!DOCTYPE html>\n" +
         element("html", "lang=\"en\"",
                 "\n" + element("head", "", "\n" + head) + element("body", "", "\n" + body));
}

void HtmlReport::save(const std::filesystem::path& file) const { write_file(file, document()); }

}  // namespace io
