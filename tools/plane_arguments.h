#pragma once
// The command line of fpo-plane.

#include <filesystem>
#include <optional>
#include <string>

#include "fpo/optimize.h"
#include "fpo/plane/plane_domain.h"
#include "geom/power/restricted_power.h"
#include "tools/cli.h"
#include "tools/plane_picture.h"

namespace tools {

struct PlaneArguments {
  std::size_t num_samples = 0;
  std::filesystem::path output, log;
  geom::Vec2 period{1, 1};
  std::string sizing = "uniform";
  double gradation = 0.3;
  std::optional<fpo::PlaneStart> start;
  std::optional<double> weight_factor;
  bool ser = false, optimize_angles = true, bounded = false;
  geom::CornerTypes corners = geom::CornerTypes::all;  ///< if bounded
  std::optional<fpo::Scope> scope;
  fpo::OptimizeOptions optimize;
  PlanePicture picture;
  bool json = false;  ///< print the summary as JSON
  bool writes_svg() const;
  bool writes_mesh() const;
};

/// Reads it, and refuses output names that cannot be written before any work starts. Throws geom::InputError.
PlaneArguments parse_plane_arguments(CommandLine& cli);

}  // namespace tools
