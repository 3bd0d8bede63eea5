#pragma once
// How well samples cover a surface (paper, section 6: "Relationship with MPS").
//
// A set of samples is a maximal Poisson-disk set if the disks about them cover the surface while none holds
// another sample. The paper asks this of disks whose radius is the least distance between any two samples
// (uniform sampling), or each sample's own least distance to another (adaptive sampling).

#include <limits>
#include <span>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace fpo {

struct Covering {
  double radius = 0;  ///< the largest distance of a location of the surface to the nearest sample
  /// radius over the least distance between two samples: the set is maximal iff this is at most 1.
  double ratio = 0;
  /// The least factor f for which disks of radius f * size about the samples cover the surface. With each
  /// sample's distance to the nearest other as its size the set is maximal iff this is at most 1.
  double local_ratio = 0;
};

/// A location of the surface with its power to the nearest of weighted points.
struct Gap {
  geom::Vec3 place{0, 0, 0};
  geom::FacetId facet;
  double power = -std::numeric_limits<double>::infinity();
};

/// The corners, of types A, B and C, of the restricted power diagram whose power is more than `above`, in the
/// order of facets; a corner of several fragments comes several times. Power is convex on a fragment, so no
/// location has more power than some corner. Cost: the diagram.
std::vector<Gap> gaps_above(const geom::TriMesh& surface, std::span<const geom::WeightedPoint3> points,
                            double above, int threads);

/// Distance of each sample to the nearest other one, in space; 0 if there is no other. O(n log n).
std::vector<double> nearest_distances(std::span<const geom::Vec3> samples);

/// Of samples on the surface or near it, each with a size that is not negative. Distances are straight ones.
/// The largest distance is that of a corner of the restricted Voronoi diagram, of any type: A, B or C. The
/// local ratio is the root f of the largest power of the surface to the samples with weights (f size)^2, by
/// Dinkelbach's steps: the power diagram for f shows where the ratio of distance to size is larger than f,
/// and the ratio there is the next f; ratios are 0 where they would be infinite (samples that coincide, no
/// size). Cost: some five diagrams. Positions must be in the exact range (geom/mesh/scaling.h). `threads` at
/// least 1; no matter to the result. Throws geom::InputError if there is no sample or no facet.
Covering covering(const geom::TriMesh& surface, std::span<const geom::Vec3> samples,
                  std::span<const double> sizes, int threads);

}  // namespace fpo
