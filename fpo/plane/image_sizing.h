#pragma once
// A sizing function from an image: dark is dense.

#include <cstddef>
#include <memory>
#include <vector>

#include "fpo/plane/plane_sizing.h"

namespace fpo {

/// Wanted sample density, up to a factor, at the centers of a grid's cells that cover the torus once; row by
/// row from the top (largest y).
struct DensityImage {
  std::size_t width = 0, height = 0;
  std::vector<float> density;  ///< in [0, 1]
};

/// What makes an image a sizing function: densities below `floor` count as floor, and the wanted edge length
/// h(x) grows by at most `gradation` times the distance.
struct ImageLimits {
  double floor = 0.01;
  double gradation = 0.3;
};

/// rho = density^-1/2, limited, periodic, bilinear between the cells' centers. The limit of the gradation
/// depends on the scale of h, hence on the number of samples. Throws InputError for an image of one single
/// value: it says nothing. O(P) a sweep for P pixels, a few sweeps.
std::unique_ptr<PlaneSizing> image_sizing(const DensityImage& image, const geom::FlatTorus& torus,
                                          std::size_t num_samples, const ImageLimits& limits = {});

}  // namespace fpo
