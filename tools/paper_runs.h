#pragma once
// The paper's experiments (section 6), run again: tables 2 to 4 and the data of figures 7 to 11.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fpo/measure/paper_rows.h"
#include "tools/convergence.h"
#include "tools/measures_table.h"
#include "tools/paper_methods.h"
#include "tools/paper_runtimes.h"
#include "tools/picture_of_spectrum.h"

namespace tools {

struct PaperOptions {
  std::filesystem::path models;  ///< a folder with files named like the paper's models
  std::uint64_t seed = 1;
  int threads = 1;
  int sets = 8;       ///< a spectrum of figure 7; half of them for those of figures 8 and 9, which are larger
  double radius = 8;  ///< of the spectra (SpectrumOptions)
  std::vector<PaperMethod> methods;  ///< empty: all
  int iterations = -1;               ///< at most; negative: the methods' own numbers
  bool tables = true, spectra = true, convergence = true, runtimes = true;
  std::function<void(const std::string&)> progress;  ///< called by any thread, one at a time
};

/// A model of the paper.
struct PaperModel {
  std::string name;            ///< as the paper spells it
  std::filesystem::path file;  ///< empty: missing
};

/// All of the paper's tables, in the order of their first row. Of several files with a model's name the first
/// one in alphabetical order counts.
std::vector<PaperModel> find_models(const std::filesystem::path& folder);

/// One of our rows.
struct PaperRun {
  fpo::PaperBlock block;
  std::string method;
  fpo::PaperFigures figures;
  double seconds = 0;  ///< of CPU, in one thread, for the remesh
};

/// One of our spectra.
struct PaperSpectrum {
  int figure = 0;
  std::string model, method;
  std::size_t samples = 0;
  MeanSpectrum mean;
  io::Svg picture{1, 1};  ///< of the first set's remesh
};

struct PaperResults {
  std::vector<PaperModel> models;
  std::vector<PaperRun> runs;  ///< in the paper's order of blocks
  std::vector<PaperSpectrum> spectra;
  Convergence convergence;                      ///< figure 10, left: the mean over the models that are there
  std::vector<std::string> convergence_models;  ///< these
  std::vector<RuntimeCurve> runtimes;
  double cpu_seconds = 0;  ///< of all jobs
};

/// Runs everything, `threads` jobs at a time; a set that tables and figures share is made once. Deterministic
/// but for times. Throws geom::InputError if no model of the paper is there, or one cannot be read or
/// remeshed. Cost: 36 minutes of CPU for eight models.
PaperResults run_paper(const PaperOptions& options);

}  // namespace tools
