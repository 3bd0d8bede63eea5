#pragma once
// The rows of the paper's tables 2 to 4, to put our own figures beside them.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fpo {

/// What the tables' columns hold, in their order and units (quality.h; d_H in percent of the diagonal).
struct PaperFigures {
  double q_min = 0, q_avg = 0, theta_min = 0, theta_min_avg = 0, theta_max = 0, theta_lt30_pct = 0,
         v567_pct = 0, d_h_pct = 0;
};

struct PaperRow {
  int table = 0;
  const char* model = "";
  const char* method = "";  ///< the acronym of table 1
  std::size_t samples = 0;  ///< as the paper rounds it: 1700 for "1.7K"
  bool adaptive = false;
  PaperFigures figures;
};

/// All rows in the paper's order.
std::span<const PaperRow> paper_rows();

/// A model at one number of samples: all rows of one block of a table.
struct PaperBlock {
  std::string model;
  int table = 0;
  std::size_t samples = 0;
  bool adaptive = false;
  std::vector<PaperRow> rows;
};

/// All blocks in the paper's order.
std::vector<PaperBlock> paper_blocks();

/// The block of a model file, by its name without folder and extension: as the paper spells it but for the
/// case of letters and digits at the end ("genus3" is Genus). None unless the number of samples is within 3
/// percent.
std::optional<PaperBlock> find_paper_block(std::string_view stem, std::size_t samples, bool adaptive);

/// Whether that stem is the model's name.
bool is_paper_model(std::string_view stem, std::string_view model);

}  // namespace fpo
