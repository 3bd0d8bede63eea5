#include "tools/paper_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/paper_table.h"
#include "tools/worded.h"

namespace tools {
namespace {

constexpr std::array<const char*, 3> table_titles = {
    "Table 2: uniform remeshing", "Table 3: adaptive remeshing", "Table 4: features and borders"};
constexpr const char* columns_note =
    "Q: 1 for an equilateral triangle; theta: angles in degrees; V567: share of interior vertices with 5, 6 "
    "or 7 "
    "edges; d_H: Hausdorff distance in percent of the input's diagonal. Best values among the paper's rows, "
    "and "
    "among ours: bold with blue noise, gray without (CVT).";

struct NamedColour {
  const char *code, *word;
};
constexpr std::array<NamedColour, 9> colours = {{{"#1d4f91", "blue"},
                                                 {"#c0392b", "red"},
                                                 {"#2a8a57", "green"},
                                                 {"#d98a00", "orange"},
                                                 {"#7d3c98", "violet"},
                                                 {"#566573", "gray"},
                                                 {"#17a2b8", "cyan"},
                                                 {"#a0522d", "brown"},
                                                 {"#e75480", "pink"}}};

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

std::string models_text(const PaperResults& results, bool found) {
  std::string text;
  for (const PaperModel& model : results.models)
    if (model.file.empty() != found) text += (text.empty() ? "" : ", ") + model.name;
  return text.empty() ? "none" : text;
}

/// One that holds all curves of the figure.
SpectrumScale common_scale(const PaperResults& results, int figure) {
  std::vector<const MeanSpectrum*> all;
  for (const PaperSpectrum& s : results.spectra)
    if (s.figure == figure) all.push_back(&s.mean);
  return scale_of(all);
}

/// Of all methods on one model: figures 7 and 8.
io::HtmlPlot radial_means(const PaperResults& results, int figure, const std::string& model) {
  io::Chart chart{"Radial means, " + model, {"frequency \u00d7 spacing", 0, 3}, {"power"}, {}, {{.y = 1}}};
  for (const PaperSpectrum& s : results.spectra) {
    if (s.figure != figure || s.model != model) continue;
    io::Series series;
    series.name = s.method;
    series.colour = colours[chart.series.size() % colours.size()].code;
    for (std::size_t i = 0; i < s.mean.curve.frequency.size(); ++i)
      series.points.emplace_back(s.mean.curve.frequency[i], s.mean.curve.mean[i]);
    chart.series.push_back(std::move(series));
  }
  const std::string legend = legend_instead_of_names(chart);
  return {io::draw_chart(chart, {560, 300}), legend};
}

void add_spectra(io::HtmlReport& page, const PaperResults& results, int figure, const std::string& heading) {
  std::vector<io::HtmlPlot> plots, means;
  std::string model;
  const SpectrumScale scale = common_scale(results, figure);
  for (const PaperSpectrum& s : results.spectra) {
    if (s.figure != figure) continue;
    const std::string name = s.model + ", " + s.method;
    plots.push_back({s.picture, name + ", " + std::to_string(s.samples) + " samples: the first set"});
    plots.push_back({draw_spectrum(s.mean, scale), name});
    const bool first = s.model != std::exchange(model, s.model);
    if (first && figure != 9) means.push_back(radial_means(results, figure, model));
  }
  page.heading(heading);
  if (plots.empty())
    page.note("Left out, or no model of it is there.");
  else
    page.plots(means);
  page.plots(plots);
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
    const std::string last =
        worded(" After %zu iterations %.4f and %.4f (the paper: .926 and .933 after 60 to 100).",
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
  const std::string caption = worded(
      "Until the mean delta is %.2f, or %d iterations: global without, local after shortest edge removal "
      "(included).",
      enough_mean_delta, most_iterations);
  const std::vector<io::HtmlPlot> removal = {
      runtime_plot(results, "11 left", "Shortest edge removal until it converges."),
      runtime_plot(results, "11 right", caption)};
  page.plots(removal);
}

std::string markdown_row(const io::HtmlTable::Row& row) {
  std::string line = "|";
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const io::HtmlTable::Mark mark = row.marks.empty() ? io::HtmlTable::Mark::none : row.marks[i];
    const char* around = mark == io::HtmlTable::Mark::bold   ? "**"
                         : mark == io::HtmlTable::Mark::gray ? "*"
                                                             : "";
    line += std::string(" ") + around + row.cells[i] + around + " |";
  }
  return line + "\n";
}

}  // namespace

io::HtmlReport paper_page(const PaperResults& results, const PaperHeader& header) {
  io::HtmlReport page("Blue-Noise Remeshing with Farthest Point Optimization: the paper's results and ours");
  page.command(header.command);
  page.paragraph("Version " + header.version + ", " + seconds_text(header.seconds) + " seconds, " +
                 seconds_text(results.cpu_seconds) + " of CPU.");
  page.paragraph("Models that are there: " + models_text(results, true) +
                 ". Missing: " + models_text(results, false) + ".");
  page.note(columns_note);
  for (int number = 2; number <= 4; ++number) {
    page.heading(table_titles[static_cast<std::size_t>(number - 2)]);
    if (const io::HtmlTable table = paper_table(results, number); !table.rows.empty()) page.table(table);
    if (const std::string missing = missing_blocks(results, number); !missing.empty()) page.note(missing);
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
    const io::HtmlTable t = paper_table(results, number);
    text += std::string("\n## ") + table_titles[static_cast<std::size_t>(number - 2)] + "\n\n";
    text += markdown_row({t.head}) + "|---|---|---|";
    for (std::size_t i = 3; i < t.head.size(); ++i) text += "---:|";
    text += "\n";
    for (const io::HtmlTable::Row& r : t.rows) text += markdown_row(r);
    if (const std::string missing = missing_blocks(results, number); !missing.empty())
      text += "\n" + missing + "\n";
  }
  return text;
}

}  // namespace tools
