#pragma once
// Sets of samples whose spectrum would say something else than is thought.

#include <filesystem>
#include <span>

#include "fpo/spectrum/spectrum_set.h"

namespace tools {

/// A line on stderr if the density of samples, taken for uniform, differs by more than it does for random
/// ones.
void warn_if_adaptive(const std::filesystem::path& input, std::span<const geom::WeightedPoint3> samples,
                      const fpo::SpectrumSurface& surface);

/// A line on stderr if one in a hundred samples lies farther from the surface than a third of the spacing.
void warn_if_elsewhere(const std::filesystem::path& input, std::span<const geom::WeightedPoint3> samples,
                       const fpo::SpectrumSurface& surface);

}  // namespace tools
