#pragma once
// Creases that are given up one by one where there are too few samples for all of them. The paper (section 5)
// keeps all features that it is given; a part that has many small ones keeps the large ones here.

#include <array>
#include <span>
#include <vector>

#include "fpo/features/curve_spacing.h"
#include "fpo/features/features.h"

namespace fpo {

/// How much of each curve there is to be seen: its length in spacings, weighed by the fold, up to 90 degrees,
/// in units of that, and less by as much as it is closer to the nearest other curve than narrow_width
/// (curve_spacing.h). What is no crease has an infinite strength. O(E log E), and a search around each place.
struct SeenCurves {
  std::vector<double> strengths, lengths;  ///< of each curve
  std::vector<NarrowPlace> places;
  double spacing;
};

SeenCurves seen_curves(const geom::TriMesh& mesh, const Features& features, double spacing);

/// How much of what there is to be seen of a curve is at each of its edges, by length and fold; 1 in all.
std::vector<double> seen_of_edges(const geom::TriMesh& mesh, const FeatureCurve& curve);

/// Of all creases.
double total_strength(const SeenCurves& curves);

struct WeakCurves {
  double share = 0.125;  ///< of the creases that are asked for
  bool only_crowded =
      false;  ///< only those that are for more than half of their length closer to others than
              ///< a quarter of a spacing: no triangles fit between
};

/// The weakest creases that are at least half a spacing long, at least one if there is any, and of two that
/// face each other only one. Shorter ones mostly collapse when those are gone that end at them, and come
/// last. Ascending; by number where strengths are equal.
std::vector<std::size_t> weakest_curves(const SeenCurves& curves, const WeakCurves& wanted);

/// The mesh edges of curves, to be FeatureOptions::unmarked.
std::vector<std::array<geom::VertexId, 2>> edges_of_curves(const Features& features,
                                                           std::span<const std::size_t> curves);

}  // namespace fpo
