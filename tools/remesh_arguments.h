#pragma once
// The command line of fpo-remesh.

#include <filesystem>

#include "fpo/remesh/lengths.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "tools/cli.h"
#include "tools/surface_input.h"

namespace tools {

struct RemeshArguments {
  std::filesystem::path input, output, points, rpd, log, picture, sizing_out, map, report, repaired;
  std::filesystem::path fixed_file;
  std::filesystem::path sizing_file;  ///< if the sizing is given
  std::string sizing_property;        ///< of its vertices, if one is named
  fpo::Lengths lengths;               ///< if no number of samples is given
  fpo::Choices choices;               ///< to complete `remesh` with once that number is known
  bool strict = false;                ///< another topology is a failure
  bool at_least = false;              ///< more samples if they are needed
  RepairArguments repair;
  fpo::RemeshOptions remesh;
};

/// Reads it, and refuses output names that cannot be written before any work starts. Throws geom::InputError.
RemeshArguments parse_remesh_arguments(CommandLine& cli);

/// Reads the fixed points if they are given by a file. Throws geom::InputError.
void read_files(RemeshArguments& a, const geom::TriMesh& input);

}  // namespace tools
