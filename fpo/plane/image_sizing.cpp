#include "fpo/plane/image_sizing.h"

#include <algorithm>
#include <cmath>

#include "fpo/plane/grid_sizing.h"
#include "geom/check.h"

namespace fpo {

using geom::FlatTorus;

namespace {

PeriodicGrid unlimited_rho(const DensityImage& image, double floor) {
  PeriodicGrid grid{image.width, image.height, std::vector<double>(image.density.size())};
  for (std::size_t j = 0; j < image.height; ++j) {
    for (std::size_t i = 0; i < image.width; ++i) {
      const double density = image.density[(image.height - 1 - j) * image.width + i];
      grid.at(i, j) = 1 / std::sqrt(std::max(density, floor));
    }
  }
  return grid;
}

}  // namespace

std::unique_ptr<PlaneSizing> image_sizing(const DensityImage& image, const FlatTorus& torus,
                                          std::size_t num_samples, const ImageLimits& limits) {
  geom::require(!image.density.empty() && image.density.size() == image.width * image.height,
                "the image has no pixels");
  const auto [least, most] = std::minmax_element(image.density.begin(), image.density.end());
  geom::require(*least < *most, "all pixels of the image are equal: it wants no density more than another");

  return grid_sizing(unlimited_rho(image, limits.floor), torus, num_samples, limits.gradation);
}

}  // namespace fpo
