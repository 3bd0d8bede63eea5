#pragma once
// The command line of fpo-spectrum.

#include <filesystem>
#include <optional>
#include <vector>

#include "fpo/spectrum/spectrum_set.h"
#include "tools/cli.h"

namespace tools {

struct SpectrumArguments {
  std::vector<std::filesystem::path> inputs;  ///< a set each; all of the plane (.txt) or none
  std::filesystem::path surface, sizes;       ///< empty: none
  std::filesystem::path picture, table;       ///< PREFIX.svg and PREFIX.csv
  bool in_plane = true;
  fpo::PlaneRegion region;
  bool json = false;   ///< print the summary as JSON
  bool plain = false;  ///< the plain periodogram
  std::optional<fpo::SpacingRule> spacing;
  fpo::SpectrumOptions spectrum;
};

/// Reads it, and refuses what does not go together and output names that cannot be written before any work
/// starts. Throws geom::InputError.
SpectrumArguments parse_spectrum_arguments(CommandLine& cli);

}  // namespace tools
