#include "tools/measures_table.h"

#include <array>

#include "tools/worded.h"

namespace tools {
namespace {

/// A column: its name, where its figure is, and how many digits the paper prints.
struct Column {
  const char* name;
  double fpo::PaperFigures::*figure;
  int digits;
};

constexpr std::array<Column, 8> columns = {{{"Q_min", &fpo::PaperFigures::q_min, 3},
                                            {"Q_avg", &fpo::PaperFigures::q_avg, 3},
                                            {"theta_min", &fpo::PaperFigures::theta_min, 2},
                                            {"theta_min avg", &fpo::PaperFigures::theta_min_avg, 2},
                                            {"theta_max", &fpo::PaperFigures::theta_max, 2},
                                            {"% < 30", &fpo::PaperFigures::theta_lt30_pct, 3},
                                            {"V567 %", &fpo::PaperFigures::v567_pct, 1},
                                            {"d_H %", &fpo::PaperFigures::d_h_pct, 2}}};

}  // namespace

std::vector<std::string> quality_columns() {
  std::vector<std::string> names;
  names.reserve(std::size(columns));
  for (const Column& c : columns) names.emplace_back(c.name);
  return names;
}

std::vector<std::string> quality_cells(const fpo::PaperFigures& figures) {
  std::vector<std::string> cells;
  cells.reserve(std::size(columns));
  for (const Column& c : columns) cells.push_back(worded("%.*f", c.digits, figures.*c.figure));
  return cells;
}

std::vector<std::string> difference_cells(const fpo::PaperFigures& a, const fpo::PaperFigures& b) {
  std::vector<std::string> cells;
  cells.reserve(std::size(columns));
  for (const Column& c : columns) cells.push_back(worded("%+.*f", c.digits, a.*c.figure - b.*c.figure));
  return cells;
}

fpo::PaperFigures figures_of(const Measures& m) {
  const fpo::Quality& q = m.quality;
  return {q.q_min,     q.q_avg,          q.theta_min, q.theta_min_avg,
          q.theta_max, q.theta_lt30_pct, q.v567_pct,  m.distance.max};
}

io::HtmlTable quality_table(const std::string& stem, const fpo::RemeshOptions& options,
                            const Measures& measures) {
  const auto row = [](std::string who, std::string samples, const std::vector<std::string>& cells) {
    std::vector<std::string> all = {std::move(who), std::move(samples)};
    all.insert(all.end(), cells.begin(), cells.end());
    return all;
  };
  io::HtmlTable table;
  table.head = row("", "samples", quality_columns());
  const auto block =
      fpo::find_paper_block(stem, options.num_samples, options.sizing != fpo::SizingKind::uniform);
  const fpo::PaperFigures own = figures_of(measures);
  const std::string name = fpo::facts_of(options.method).acronym;
  const fpo::PaperRow* theirs = nullptr;
  if (block) {
    for (const fpo::PaperRow& r : block->rows) {
      table.rows.push_back(
          {row(std::string("paper: ") + r.method, std::to_string(r.samples), quality_cells(r.figures))});
      if (r.method == name) theirs = &r;
    }
  }
  table.rows.push_back({row("this run", std::to_string(options.num_samples), quality_cells(own)), true});
  if (theirs)
    table.rows.push_back({row("this run - paper: " + name, "", difference_cells(own, theirs->figures))});
  return table;
}

}  // namespace tools
