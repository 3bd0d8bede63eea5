#pragma once
// How many samples the surface between feature curves calls for, if those on curves are there already.

#include <vector>

#include "fpo/features/features.h"
#include "fpo/surface/sizing.h"

namespace fpo {

/// Each curve has half a row of the hexagonal arrangement to either side, sqrt(3) / 4 of a wanted length
/// wide. Of what is farther from all curves the density is that of the sizing. So bars, thin walls and narrow
/// strips call for no inner samples, and it takes more samples on curves than by their area; elsewhere the
/// sum is the number for the area, about.
class InnerShare {
 public:
  /// Of wanted lengths that are `scale` times the sizing's. Looks at some sixteen places for each sample that
  /// these call for. O(places + F), by a grid.
  InnerShare(const geom::TriMesh& mesh, const Features& features, const Sizing& sizing, double scale = 1);

  /// If all of these lengths are so many times longer, at most twice. O(log places).
  double num_samples(double stretching = 1) const;

 private:
  struct Place {
    double distance;  ///< from the curves, in wanted lengths
    double samples;   ///< of the part of the surface that it stands for and of all that are farther
  };
  std::vector<Place> places_;  ///< ascending by distance
};

}  // namespace fpo
