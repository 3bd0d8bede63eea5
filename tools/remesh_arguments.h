#pragma once
// The command line of fpo-remesh.

#include <filesystem>

#include "fpo/remesh/lengths.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "tools/cli.h"
#include "tools/surface_input.h"

namespace tools {

/// What else is a feature: marked in the input.
struct FeatureWords {
  bool seams = false, groups = false, lines = false;
  std::vector<std::filesystem::path> files;  ///< of polylines
  bool any() const { return seams || groups || lines || !files.empty(); }
};

struct RemeshArguments {
  std::filesystem::path input, output, points, rpd, log, picture, sizing_out, map, report, repaired;
  std::filesystem::path fixed_file;
  std::filesystem::path sizing_file;  ///< if the sizing is given
  std::string sizing_property;        ///< of its vertices, if one is named
  fpo::Lengths lengths;               ///< if no number of samples is given
  fpo::Choices choices;               ///< to complete `remesh` with once that number is known
  bool strict = false;                ///< another topology is a failure
  bool at_least = false;              ///< more samples if they are needed
  bool carry = false;                 ///< colours, numbers and texture coordinates of the input's vertices
  bool hausdorff = false;             ///< measure the distance from the input
  bool json = false;                  ///< print the summary as JSON
  FeatureWords feature_words;
  RepairArguments repair;
  fpo::RemeshOptions remesh;
};

/// Reads it, and refuses output names that cannot be written before any work starts. Throws geom::InputError.
RemeshArguments parse_remesh_arguments(CommandLine& cli);

/// Reads the fixed points if they are given by a file. Throws geom::InputError.
void read_files(RemeshArguments& a, const geom::TriMesh& input);

}  // namespace tools
