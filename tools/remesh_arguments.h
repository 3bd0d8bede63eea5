#pragma once
// The command line of fpo-remesh.

#include <filesystem>

#include "fpo/pipeline.h"
#include "tools/cli.h"

namespace tools {

struct RemeshArguments {
  std::filesystem::path input, output, points, rpd, log, picture;
  fpo::RemeshOptions remesh;
};

/// Reads it, and refuses output names that cannot be written before any work starts. Throws geom::InputError.
RemeshArguments parse_remesh_arguments(CommandLine& cli);

}  // namespace tools
