#pragma once
// Which lines are kept as features at a given number of samples. The paper (section 5) takes features as
// given; folds between facets are not all creases that somebody would want: noise, scans and carved bodies
// have them everywhere, and lines closer than the samples cannot be kept.

#include <span>
#include <string>

#include "fpo/features/features.h"
#include "fpo/surface/surface_sample.h"

namespace fpo {

/// In spacings: shorter curves on creases collapse.
inline constexpr double shortest_curve = 0.5;

/// What is known of the remesh before anything is sampled.
struct SamplingPlan {
  std::size_t num_samples = 0;
  double spacing = 0;  ///< of that many samples if they were spread evenly
  std::span<const SurfaceSample> fixed{};
  bool strong_only = false;  ///< weak creases are known to do harm: give them up if features are yielding
};

struct FeatureChoice {
  Features features;
  std::string given_up;       ///< which features are not kept and why, for users; empty: none of them
  bool are_missed = false;    ///< those are of the shape: neither noise upon it nor steps of a lattice
  std::size_t collapsed = 0;  ///< curves that were too short
};

/// The features of a mesh. Turns are seen at half the spacing. Curves on creases that are shorter than that
/// collapse: their ends become one corner, to which the other curves there are led. Not so if curves run side
/// by side from both ends: at the end of a strip.
///
/// If the features are `yielding`: creases that fade out count as closed from twenty spacings on, and are
/// dropped if shorter than two. Where the features would need more than half of the samples, the weakest
/// creases (weak_curves.h) are given up until they need a third, and no two are side by side with hardly a
/// triangle between. All creases are dropped if that takes half of what there is to be seen, if they cross
/// each other everywhere, are edges cut off in steps by a lattice, or are folded as noise is (fold_sides.h);
/// then corners, if borders need more samples than there are. Borders stay. Else nothing is dropped.
FeatureChoice choose_features(const geom::TriMesh& mesh, FeatureOptions options, const SamplingPlan& plan);

/// Is any curve a crease?
bool has_creases(const Features& features);

/// All those that could be kept with enough samples: with turns seen between mesh edges, none given up, none
/// collapsed. What fades out is judged at this spacing. None if the creases are dropped however many samples
/// there are, as noise.
Features all_features(const geom::TriMesh& mesh, FeatureOptions options, double spacing);

/// Joins the ends of curves that are shorter than `reach`, the shortest first; `features` is of that mesh.
/// Ends of strips, borders and non-manifold edges stay as they are. What closes to a loop shorter than three
/// times that goes. O(curves^2) if many are short.
Features with_short_curves_collapsed(const geom::TriMesh& mesh, Features features, double reach);

}  // namespace fpo
