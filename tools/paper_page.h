#pragma once
// The paper's tables and figures with our own results beside them, as a page and as Markdown.

#include <string>

#include "io/html_report.h"
#include "tools/paper_runs.h"

namespace tools {

/// What both say of how the results came about.
struct PaperHeader {
  std::string command, version;
  double seconds = 0;  ///< of the clock
};

io::HtmlReport paper_page(const PaperResults& results, const PaperHeader& header);

/// Tables 2 to 4 only.
std::string paper_markdown(const PaperResults& results, const PaperHeader& header);

}  // namespace tools
