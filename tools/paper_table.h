#pragma once
// One of the paper's tables 2 to 4 with our rows in it.

#include <string>

#include "io/html_report.h"
#include "tools/paper_runs.h"

namespace tools {

/// The blocks of the models that are there. A block has a row for each method of ours; above it the paper's
/// row of that method, where there is one, below it the difference. In each block and column the best value
/// of the methods with blue noise is bold, and a better one of CVT, which has none, gray, as the paper does:
/// once among the paper's rows and once among ours.
io::HtmlTable paper_table(const PaperResults& results, int number);

/// The blocks of models that are missing, in one sentence; empty: none.
std::string missing_blocks(const PaperResults& results, int number);

/// One decimal.
std::string seconds_text(double seconds);

}  // namespace tools
