#pragma once
// Our figures in the columns of the paper's tables 2 to 4.

#include <string>
#include <vector>

#include "fpo/measure/paper_rows.h"
#include "fpo/remesh/pipeline.h"
#include "io/html_report.h"
#include "tools/measures.h"

namespace tools {

/// The tables' columns with figures.
std::vector<std::string> quality_columns();
/// The figures in that order, with as many digits as the paper prints.
std::vector<std::string> quality_cells(const fpo::PaperFigures& figures);
/// The same, with a sign: how much `a` exceeds `b`.
std::vector<std::string> difference_cells(const fpo::PaperFigures& a, const fpo::PaperFigures& b);

/// Those of a mesh that was compared with its reference.
fpo::PaperFigures figures_of(const Measures& measures);

/// This run; above it the paper's rows, if the model (by its file's stem), the number of samples and the kind
/// of sizing are in the paper; below it how it differs from the paper's figures of its method.
io::HtmlTable quality_table(const std::string& stem, const fpo::RemeshOptions& options,
                            const Measures& measures);

}  // namespace tools
