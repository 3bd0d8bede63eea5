#include "tools/paper_table.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "tools/worded.h"

namespace tools {
namespace {

using Mark = io::HtmlTable::Mark;

constexpr std::size_t first_figure = 3;  ///< the columns before: model, samples, whose
constexpr std::string_view without_blue_noise = "CVT";

/// A column of the tables: where its figure is, and whether more is better.
struct Judged {
  double fpo::PaperFigures::*figure;
  bool more_is_better;
};
constexpr std::array<Judged, 8> judged = {{{&fpo::PaperFigures::q_min, true},
                                           {&fpo::PaperFigures::q_avg, true},
                                           {&fpo::PaperFigures::theta_min, true},
                                           {&fpo::PaperFigures::theta_min_avg, true},
                                           {&fpo::PaperFigures::theta_max, false},
                                           {&fpo::PaperFigures::theta_lt30_pct, false},
                                           {&fpo::PaperFigures::v567_pct, true},
                                           {&fpo::PaperFigures::d_h_pct, false}}};

/// A row of figures, the paper's or ours, of one block.
struct Entry {
  std::string method;
  fpo::PaperFigures figures;
};

/// How far ahead: more is better.
double rank(const Entry& entry, const Judged& column) {
  const double value = entry.figures.*column.figure;
  return column.more_is_better ? value : -value;
}

std::vector<Mark> marks(const Entry& entry, const std::vector<Entry>& all) {
  std::vector<Mark> result(first_figure, Mark::none);
  const bool blue = entry.method != without_blue_noise;
  for (const Judged& column : judged) {
    double best = -std::numeric_limits<double>::infinity();
    for (const Entry& other : all)
      if (!blue || other.method != without_blue_noise) best = std::max(best, rank(other, column));
    const bool is_best = all.size() > 1 && rank(entry, column) >= best;
    result.push_back(!is_best ? Mark::none : blue ? Mark::bold : Mark::gray);
  }
  result.push_back(Mark::none);  // seconds
  return result;
}

io::HtmlTable::Row row(const fpo::PaperBlock& block, const std::string& whose,
                       const std::vector<std::string>& cells, const std::string& seconds) {
  io::HtmlTable::Row result;
  result.cells = {block.model, std::to_string(block.samples) + (block.adaptive ? " adaptive" : ""), whose};
  result.cells.insert(result.cells.end(), cells.begin(), cells.end());
  result.cells.push_back(seconds);
  return result;
}

void add_block(io::HtmlTable& out, const fpo::PaperBlock& block, const PaperResults& results) {
  std::vector<Entry> theirs, ours;
  for (const fpo::PaperRow& r : block.rows) theirs.push_back({r.method, r.figures});
  std::vector<const PaperRun*> runs;
  for (const PaperRun& run : results.runs) {
    const fpo::PaperBlock& b = run.block;
    if (b.table != block.table || b.model != block.model || b.samples != block.samples) continue;
    ours.push_back({run.method, run.figures});
    runs.push_back(&run);
  }
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const auto paper = std::ranges::find(theirs, ours[i].method, &Entry::method);
    if (paper != theirs.end()) {
      out.rows.push_back(row(block, "paper: " + paper->method, quality_cells(paper->figures), ""));
      out.rows.back().quiet = true;
      out.rows.back().marks = marks(*paper, theirs);
    }
    out.rows.push_back(row(block, "ours: " + ours[i].method, quality_cells(ours[i].figures),
                           seconds_text(runs[i]->seconds)));
    out.rows.back().marks = marks(ours[i], ours);
    if (paper == theirs.end()) continue;
    out.rows.push_back(row(block, "difference", difference_cells(ours[i].figures, paper->figures), ""));
    out.rows.back().quiet = true;
  }
}

bool is_there(const PaperResults& results, const std::string& model) {
  const auto found = std::ranges::find(results.models, model, &PaperModel::name);
  return found != results.models.end() && !found->file.empty();
}

}  // namespace

std::string seconds_text(double seconds) { return worded("%.1f", seconds); }

io::HtmlTable paper_table(const PaperResults& results, int number) {
  io::HtmlTable out;
  out.head = {"model", "samples", "method"};
  for (const std::string& name : quality_columns()) out.head.push_back(name);
  out.head.emplace_back("CPU s");
  for (const fpo::PaperBlock& block : fpo::paper_blocks())
    if (block.table == number && is_there(results, block.model)) add_block(out, block, results);
  return out;
}

std::string missing_blocks(const PaperResults& results, int number) {
  std::string text;
  for (const fpo::PaperBlock& block : fpo::paper_blocks())
    if (block.table == number && !is_there(results, block.model))
      text += (text.empty() ? "Left out, for the model is missing: " : ", ") + block.model + " " +
              std::to_string(block.samples);
  return text.empty() ? text : text + ".";
}

}  // namespace tools
