#include "tools/paper_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tools {
namespace {

constexpr std::array<const char*, 3> table_titles = {
    "Table 2: uniform remeshing", "Table 3: adaptive remeshing", "Table 4: features and borders"};
constexpr const char* columns_note =
    "Q: 1 for an equilateral triangle; theta: angles in degrees; V567: share of interior vertices with 5, 6 "
    "or 7 "
    "edges; d_H: Hausdorff distance in percent of the input's diagonal.";

struct NamedColour {
  const char *code, *word;
};
constexpr std::array<NamedColour, 6> colours = {{{"#1d4f91", "blue"},
                                                 {"#c0392b", "red"},
                                                 {"#2a8a57", "green"},
                                                 {"#d98a00", "orange"},
                                                 {"#7d3c98", "violet"},
                                                 {"#566573", "gray"}}};

/// Names at the ends of curves that end together lie on each other: these words go beneath the chart instead.
std::string legend_instead_of_names(io::Chart& chart) {
  std::string text;
  for (io::Series& series : chart.series) {
    const auto colour = std::ranges::find(colours, series.colour, &NamedColour::code);
    text += (text.empty() ? "" : "; ") + std::string(colour == colours.end() ? series.colour : colour->word) +
            ": " + series.name;
    series.name.clear();
  }
  return text + ".";
}

io::HtmlPlot runtime_plot(const PaperResults& results, const std::string& figure,
                          const std::string& caption) {
  io::Chart chart = runtimes_chart(results.runtimes, figure);
  const std::string legend = legend_instead_of_names(chart);
  return {io::draw_chart(chart), caption + " " + legend};
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", seconds);
  return text;
}

/// Model and samples, whose figures, the figures, seconds.
io::HtmlTable::Row row(const fpo::PaperBlock& block, const std::string& whose, std::vector<std::string> cells,
                       const std::string& seconds) {
  std::vector<std::string> all = {block.model,
                                  std::to_string(block.samples) + (block.adaptive ? " adaptive" : ""), whose};
  all.insert(all.end(), cells.begin(), cells.end());
  all.push_back(seconds);
  return {all};
}

/// All blocks of one of the paper's tables: each of the paper's rows, beneath it ours and the difference.
/// Models that are missing have the paper's rows only.
io::HtmlTable table(const PaperResults& results, int number) {
  io::HtmlTable out;
  out.head = {"model", "samples", "method"};
  for (const std::string& name : quality_columns()) out.head.push_back(name);
  out.head.push_back("CPU s");
  for (const fpo::PaperBlock& block : fpo::paper_blocks()) {
    if (block.table != number) continue;
    for (const fpo::PaperRow& theirs : block.rows) {
      out.rows.push_back(
          row(block, std::string("paper: ") + theirs.method, quality_cells(theirs.figures), ""));
      for (const PaperRun& run : results.runs) {
        if (run.method != theirs.method || run.block.table != block.table || run.block.model != block.model ||
            run.block.samples != block.samples)
          continue;
        out.rows.push_back(
            row(block, "ours: " + run.method, quality_cells(run.figures), seconds_text(run.seconds)));
        out.rows.back().own = true;
        out.rows.push_back(row(block, "difference", difference_cells(run.figures, theirs.figures), ""));
      }
    }
  }
  return out;
}

std::string models_text(const PaperResults& results, bool found) {
  std::string text;
  for (const PaperModel& model : results.models)
    if (model.file.empty() != found) text += (text.empty() ? "" : ", ") + model.name;
  return text.empty() ? "none" : text;
}

void add_spectra(io::HtmlReport& page, const PaperResults& results, int figure, const std::string& heading) {
  std::vector<io::HtmlPlot> plots;
  io::Chart radial{"Radial means", {"frequency \u00d7 spacing", 0, 3}, {"power"}, {}, {{.y = 1}}};
  for (const PaperSpectrum& s : results.spectra) {
    if (s.figure != figure) continue;
    const std::string name = s.model + ", " + s.method;
    plots.push_back({draw_spectrum(s.mean), name + ", " + std::to_string(s.samples) + " samples"});
    io::Series series;
    series.colour = colours[radial.series.size() % colours.size()].code;
    for (std::size_t i = 0; i < s.mean.curve.frequency.size(); ++i)
      series.points.push_back({s.mean.curve.frequency[i], s.mean.curve.mean[i]});
    series.name = name;
    radial.series.push_back(std::move(series));
  }
  page.heading(heading);
  if (plots.empty()) {
    page.note("Left out, or no model of it is there.");
    return;
  }
  page.plots(plots);
  if (radial.series.size() < 2) return;
  const std::string legend = legend_instead_of_names(radial);
  const std::vector<io::HtmlPlot> together = {{io::draw_chart(radial, {560, 300}), legend}};
  page.plots(together);
}

void add_convergence(io::HtmlReport& page, const PaperResults& results) {
  page.heading("Figure 10: convergence (left), runtime of one iteration (right)");
  std::vector<io::HtmlPlot> plots;
  const Convergence& c = results.convergence;
  if (!c.delta.empty()) {
    io::Chart chart = convergence_chart(std::span(ways).first(1), {&c, 1});
    chart.title = "Figure 10 left";
    std::string models;
    for (const std::string& model : results.convergence_models)
      models += (models.empty() ? "" : ", ") + model;
    char last[160];
    std::snprintf(last, sizeof last,
                  " After %zu iterations %.4f and %.4f (the paper: .926 and .933 after 60 to 100).",
                  c.delta.size() - 1, c.delta.back(), c.mean_delta.back());
    plots.push_back({io::draw_chart(chart), "Mean over " + models + "." + last});
  }
  if (!results.runtimes.empty())
    plots.push_back(runtime_plot(results, "10 right", "One iteration (the second) of global optimization."));
  if (plots.empty()) page.note("Left out.");
  page.plots(plots);
  page.heading("Figure 11: shortest edge removal");
  if (results.runtimes.empty()) {
    page.note("Left out.");
    return;
  }
  char caption[200];
  std::snprintf(
      caption, sizeof caption,
      "Until the mean delta is %.2f, or %d iterations: global without, local after shortest edge removal "
      "(included).",
      enough_mean_delta, most_iterations);
  const std::vector<io::HtmlPlot> removal = {
      runtime_plot(results, "11 left", "Shortest edge removal until it converges."),
      runtime_plot(results, "11 right", caption)};
  page.plots(removal);
}

std::string markdown_row(const std::vector<std::string>& cells, bool bold) {
  std::string line = "|";
  for (const std::string& cell : cells)
    line += " " + (bold && !cell.empty() ? "**" + cell + "**" : cell) + " |";
  return line + "\n";
}

}  // namespace

io::HtmlReport paper_page(const PaperResults& results, const PaperHeader& header) {
  io::HtmlReport page("Blue-Noise Remeshing with Farthest Point Optimization: the paper's results and ours");
  page.command(header.command);
  page.paragraph("Version " + header.version + ", " + seconds_text(header.seconds) + " seconds.");
  page.paragraph("Models that are there: " + models_text(results, true) +
                 ". Missing: " + models_text(results, false) + ".");
  page.note(columns_note);
  for (int number = 2; number <= 4; ++number) {
    page.heading(table_titles[static_cast<std::size_t>(number - 2)]);
    page.table(table(results, number));
  }
  add_spectra(page, results, 7, "Figure 7: spectra of uniform samples");
  add_spectra(page, results, 8, "Figure 8: spectra of adaptive samples");
  add_spectra(page, results, 9, "Figure 9: spectra of samples with features");
  add_convergence(page, results);
  return page;
}

std::string paper_markdown(const PaperResults& results, const PaperHeader& header) {
  std::string text = "# The paper's tables and our figures\n\n`" + header.command + "`, version " +
                     header.version + "\n\nModels that are there: " + models_text(results, true) +
                     ". Missing: " + models_text(results, false) + ".\n\n" + columns_note + "\n";
  for (int number = 2; number <= 4; ++number) {
    const io::HtmlTable t = table(results, number);
    text += std::string("\n## ") + table_titles[static_cast<std::size_t>(number - 2)] + "\n\n";
    text += markdown_row(t.head, false) + "|---|---|---|";
    for (std::size_t i = 3; i < t.head.size(); ++i) text += "---:|";
    text += "\n";
    for (const io::HtmlTable::Row& r : t.rows) text += markdown_row(r.cells, r.own);
  }
  return text;
}

}  // namespace tools
