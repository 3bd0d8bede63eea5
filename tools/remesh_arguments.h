#pragma once
// The command line of fpo-remesh.

#include <filesystem>

#include "fpo/pipeline.h"
#include "tools/cli.h"

namespace tools {

struct RemeshArguments {
  std::filesystem::path input, output, points, rpd, log, picture, sizing_out;
  std::string sizing = "uniform";  ///< or a file
  fpo::RemeshOptions remesh;
};

/// Reads it, and refuses output names that cannot be written before any work starts. Throws geom::InputError.
RemeshArguments parse_remesh_arguments(CommandLine& cli);

/// --sizing for a mesh: the rho of fpo::RemeshOptions. Throws geom::InputError.
fpo::VertexField wanted_sizes(const RemeshArguments& a, const geom::TriMesh& input);

}  // namespace tools
