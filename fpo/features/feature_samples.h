#pragma once
// Samples on features (paper, section 5): corners are samples, each curve gets as many as the sizing calls
// for along it (cf. [AVDI05]), placed by farthest point optimization in one dimension. They stay where they
// are while the others are optimized.

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "fpo/features/facing_curves.h"
#include "fpo/features/features.h"
#include "fpo/features/given_points.h"
#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_sample.h"
#include "geom/ids.h"

namespace fpo {

/// Samples with ids 0, 1, ...: the user's points, corners, then those along curves.
struct FeatureSamples {
  std::vector<SurfaceSample> samples;
  /// The samples along each curve of the features, in order, corners included; of a loop the last is the
  /// first again. Each two that follow each other should be an edge of the remesh.
  std::vector<std::vector<geom::SiteId>> chains;
  std::vector<std::size_t> sheets;  ///< of each curve: facets at its edges
  /// By how much the samples' shares of the surface fall short of those of as many inner samples: half a
  /// share for each on a border, nothing for one on a crease.
  double missing_shares = 0;
  std::size_t num_given = 0;         ///< the user's points and corners: the first ones, which never move
  std::size_t staggered_curves = 0;  ///< whose samples are opposite to the middles of another's edges
};

struct CurveSampling {
  std::size_t most = 0;  ///< samples
  std::uint64_t seed = 1;
  std::span<const FacingPair> pairs = {};  ///< of the features, to be staggered (facing_curves.h)
  bool facing = false;                     ///< samples of close curves face each other (facing_samples.h)
  bool staggered = true;                   ///< share_sizing() finds pairs, unless samples face each other
};

/// Samples all features, with about the spacing that the sizing wants, but not more than `most` samples in
/// all. Where edges would be 1.6 to 3.4 widths of the strip between facing curves long, samples of one are
/// opposite to the middles of the other's edges. Between two fixed ones there is at least what makes the
/// curves a simplicial complex: a loop has three edges, and only one of several curves between the same two
/// corners may be a single edge, the shortest. `fixed` points on a curve divide it. Where curves leave a
/// corner at an angle a below 60 degrees, all of these have their first sample at the same distance from it,
/// longer than later gaps by as much as it takes for triangles between the curves to have angles of
/// min(30, a); staggered ones have not. Throws InputError, naming the least number, if that is more than
/// `most`. Deterministic.
FeatureSamples sample_features(const geom::TriMesh& mesh, const Features& features,
                               std::span<const SurfaceSample> fixed, const Sizing& sizing,
                               const CurveSampling& options);

/// Edges of a curve of a length in wanted lengths: so many that their length is nearest to 1, and not so
/// long that an inner sample could come between their ends: those keep a distance of .9 or more from both.
std::size_t wanted_edges(double length);

/// What sample_features() needs at least.
std::size_t least_number_of_samples(const geom::TriMesh& mesh, const Features& features,
                                    std::span<const SurfaceSample> fixed);

/// The sizing that features and interior share, with the samples on the features.
struct SharedSizing {
  Sizing sizing;
  FeatureSamples features;
  bool has_small_parts = false;  ///< components for which it calls for just enough (remesh/small_parts.h)
};

/// Finds it for exactly n samples. `sizing_for` gives the sizing that calls for so many inner samples; it is
/// asked for as many as have the shares of all samples, again until that is steady: two or three times.
/// (With B of n vertices on borders there are 2 n - B - 2 chi triangles, by Euler's formula: as many as n -
/// B / 2 - chi inner ones have.)
/// `sampling`: n is the most; pairs are found here, if they are to be.
SharedSizing share_sizing(const geom::TriMesh& mesh, const Features& features,
                          std::span<const SurfaceSample> fixed,
                          const std::function<Sizing(std::size_t)>& sizing_for, CurveSampling sampling);

/// The edges of the chains that are no edges of a remesh whose first vertices are the samples, in the order
/// of the chains. O(F log F).
std::vector<std::pair<geom::SiteId, geom::SiteId>> broken_edges(const geom::TriMesh& remesh,
                                                                const FeatureSamples& features);
/// The edges of the chains.
std::size_t num_edges(const FeatureSamples& features);

}  // namespace fpo
