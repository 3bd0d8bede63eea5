#pragma once
// How well samples on the flat torus follow the sizing, and the angles of their triangulation (section 6).

#include <cstddef>

#include "fpo/plane/plane_domain.h"

namespace fpo {

struct PlaneQuality {
  double delta = 0, mean_delta = 0;  ///< minimum and mean of spacing / wanted edge length
  double spacing_variation = 0;      ///< standard deviation of the same by its mean
  double grading_slope = 1;  ///< of log spacing against log wanted edge length, least squares; 1 if uniform
  double min_angle = 0, mean_min_angle = 0, max_angle = 0;  ///< degrees
  std::size_t angles_below_30 = 0;
  std::size_t hidden = 0;  ///< samples without a power cell
};

/// O(n).
PlaneQuality plane_quality(PlaneDomain& domain);

}  // namespace fpo
