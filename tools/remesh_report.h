#pragma once
// What fpo-remesh --report writes: a run with its pictures, charts and figures on one page.

#include <filesystem>
#include <string>
#include <vector>

#include "fpo/remesh/pipeline.h"

namespace tools {

/// How a remesh came about.
struct RemeshRun {
  std::string command;  ///< as it was typed
  std::filesystem::path input;
  fpo::RemeshOptions options;
  std::vector<fpo::IterationReport> iterations;
  double seconds = 0;  ///< of fpo::remesh
  int threads = 1;
  bool quiet = false;  ///< no progress line
};

/// Measures the remesh (like fpo-quality with the input as reference) and writes the page, atomically. The
/// run kept its cells (RemeshOptions::keep_cells). The spectrum is left out beyond 15,000 samples, which the
/// page says. Throws geom::InputError if the file cannot be written.
void write_remesh_report(const std::filesystem::path& path, const geom::TriMesh& input,
                         const fpo::RemeshResult& result, const RemeshRun& run);

}  // namespace tools
