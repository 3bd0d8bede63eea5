#pragma once
// A page in one file: text, tables, charts and scenes that can be turned. It opens in any browser, asks
// nothing of any network, and follows the reader's light or dark colour scheme.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene.h"
#include "io/svg.h"

namespace io {

struct HtmlTable {
  enum class Mark { none, bold, gray };  ///< gray: on a gray ground
  struct Row {
    std::vector<std::string> cells;
    bool own = false;              ///< in bold: what the page is about
    bool quiet = false;            ///< in a paler colour: what it is compared with
    std::vector<Mark> marks = {};  ///< of the cells; empty: none
  };
  std::vector<std::string> head;  ///< empty: none
  std::vector<Row> rows;          ///< the first column flush left, the others right
  bool words = false;             ///< long texts in the other columns: flush left, in several lines
};

struct HtmlPlot {
  Svg svg;
  std::string caption = {};
};

/// What is added appears in that order. All texts are plain: they are escaped here.
class HtmlReport {
 public:
  explicit HtmlReport(std::string_view title);

  void heading(std::string_view text);
  void paragraph(std::string_view text);
  void note(std::string_view text);     ///< in small print
  void banner(std::string_view text);   ///< what nobody must overlook
  void command(std::string_view text);  ///< a command line
  void table(const HtmlTable& table);
  /// The same behind a line that opens it.
  void folded(std::string_view line, const HtmlTable& table);
  void plots(std::span<const HtmlPlot> plots);  ///< beside each other as far as they fit
  /// Once a page. `still`: what is shown where scripts are off.
  void scenes(std::span<const Scene> scenes, const SceneView& view, const Svg& still);
  /// A JSON object for programs, not shown; found by its id. "</" must not occur in it.
  void data(std::string_view id, std::string_view json);

  /// The whole page: HTML 5 that is well-formed XML up to the doctype, scripts and styles.
  std::string document() const;
  /// Writes it atomically (atomic_file.h).
  void save(const std::filesystem::path& file) const;

 private:
  std::string title_, body_;
  bool has_scenes_ = false;
};

}  // namespace io
