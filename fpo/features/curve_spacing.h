#pragma once
// Wanted lengths that know the curves: where two feature curves, or parts of one, come closer to each other
// than the samples, the strip between them can only be meshed well if samples there are as close (cf. the
// protection of creases by Cheng, Dey, Levine 2007, and the local feature size of curves that it rests on).

#include <optional>
#include <vector>

#include "fpo/features/features.h"
#include "fpo/surface/sizing.h"
#include "fpo/surface/split_facets.h"

namespace fpo {

/// In lengths that are wanted: wider strips between curves have good triangles as they are.
inline constexpr double narrow_width = 0.6;

/// A place on a curve that faces another one across the surface.
struct NarrowPlace {
  geom::Vec3 at;
  double width;              ///< of the strip between
  std::size_t curve, other;  ///< that it is on, and that it faces
  double length;             ///< of the part of the curve that it stands for
  bool nearest;              ///< of the curves that the place faces
};

/// Those with a width below narrow_width times the spacing, some five a spacing or, if less, a width; one
/// for each curve that a place faces, of the twelve nearest. Two places face each other if the middle between
/// them is near the surface, if they are on one body (another one's curves may cross where both touch), and
/// if they are not beside each other on one curve or at a corner where both curves begin. Ascending along the
/// curves. None if curves are longer than sixty spacings a sample: most strips are too narrow for any help.
/// O(F + places), by a grid, where facets do not lie through each other.
std::vector<NarrowPlace> narrow_places(const geom::TriMesh& mesh, const Features& features, double spacing);
/// Those with the nearest curve that they face, in less time; also if they are as near beside the longest
/// length that is wanted on curves, if that is more than the spacing.
std::vector<NarrowPlace> nearest_places(const geom::TriMesh& mesh, const Features& features, double spacing,
                                        double longest = 0);

/// A surface with narrow places, and the same one with facets that are small beside the lengths wanted there.
struct NarrowSurface {
  SplitSurface split;
  std::vector<NarrowPlace> places;  ///< with the nearest curve each
  double gradation = 0;
  VertexField lengths;  ///< at each vertex of the split mesh: the least of 1.5 widths + gradation * distance
  VertexField distances;  ///< from the nearest place; both +infinity far from all
};

/// None if there is no narrow place, if facets are such needles that they cannot be split with some sixty
/// facets a sample.
std::optional<NarrowSurface> narrow_surface(const geom::TriMesh& mesh, const Features& features,
                                            double spacing, double gradation, double longest = 0);

/// The same places on a surface that is split for lengths of at least that: for those that are possible.
void split_less(NarrowSurface& narrow, const geom::TriMesh& mesh, double spacing, double least);

struct CurveFit {
  Sizing sizing;
  bool helped;   ///< any narrow place: else the sizing is that of before
  double least;  ///< length at narrow places, if so
};

/// The wanted lengths on `narrow`, which was made of `mesh`, that call for n samples: those of `base`, times
/// the same number everywhere, but at most 1.5 widths plus the gradation times the distance from each place,
/// as far as that is not below a least length: one with which others need not be longer than 1.35 of what
/// they are. It is no help where that is more than twice what the narrow places want. `base` is of `mesh`.
/// Some fifty evaluations of the number of samples.
CurveFit fit_sizing_to_curves(const geom::TriMesh& mesh, const Sizing& base, const NarrowSurface& narrow,
                              std::size_t n);

}  // namespace fpo
