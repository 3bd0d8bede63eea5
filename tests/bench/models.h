#pragma once
// The paper's models, for benchmarks.

#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/convergence.h"

namespace bench {

/// NAME.obj in the folder named by FPO_MODELS (default ../shared/models). It may be missing.
inline std::filesystem::path model_file(const std::string& name) {
  const char* folder = std::getenv("FPO_MODELS");
  return std::filesystem::path(folder ? folder : "../shared/models") / (name + ".obj");
}

struct Model {
  std::string name;
  std::filesystem::path file;
  std::size_t samples;
};

/// Those of figure 10 that are there.
inline std::vector<Model> models_of_figure_10() {
  std::vector<Model> models;
  for (const tools::ConvergenceCase& c : tools::convergence_cases) {
    std::string name = c.model;
    for (char& letter : name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (std::filesystem::exists(model_file(name))) models.push_back({name, model_file(name), c.samples});
  }
  return models;
}

}  // namespace bench
