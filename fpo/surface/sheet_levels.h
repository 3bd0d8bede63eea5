#pragma once
// Sheets apart: levels (geom/mesh/levels.h) for the sheets of a surface that are nearer to each other in
// space than samples are, but not along the surface. The paper's diagram is one of space, so that there
// samples of one sheet push those of the other, and cells reach through. (Cf. Yan, Bao, Zhang, Wonka,
// Low-resolution remeshing using the localized restricted Voronoi diagram, 2014, who part the cells of given
// samples; here the sheets are apart while samples are distributed.)
//
//       top     ______________       Two places are in conflict if they are nearer than `near` wanted lengths
//              /              \      in space, and farther than `far` of them along the surface. Places in
//       side  |                |     conflict make patches, and these are coloured so that patches in
//              \______________/      conflict have different colours; color times `height` is the level
//       bottom                       wanted there. What is far from all of them has level 0.
//
// Between them the level u = (L + U) / 2, with L(v) = max (t_w - g d(v, w)) and U(v) = min (t_w + g d(v, w))
// over all places w where level t_w is wanted, d the distance along edges. It is t where the wishes allow,
// and nowhere steeper than g: opposite places of a thin plate, d from each other around its rim, differ by
// about min(height, g d). Steeper levels would part more near rims, but a triangle is shorter in space than
// in four coordinates by up to sqrt(1 + g^2) along the gradient.
//
// A component of the surface that is in conflict with another one gets a level of its own, all of it.

#include <optional>

#include "fpo/surface/sizing.h"
#include "fpo/surface/split_facets.h"

namespace fpo {

/// Lengths in units of the wanted edge length.
struct SheetOptions {
  double near = 1.1;       ///< in space
  double far = 2.5;        ///< along the surface
  double height = 1.4;     ///< between the levels of sheets
  double slope = 0.45;     ///< g
  double longest = 0.6;    ///< edge of the facets that levels are found on
  double largest = 1;      ///< edge of those that they are kept on, if they are linear there
  double tolerance = 0.1;  ///< but for this
};

/// The surface with levels, its facets parts of those of the old one; nothing if no places are in conflict,
/// or if facets are such needles that there would be more than some 500 parts a sample. A function of mesh
/// and sizing alone. Samples change to the facets of the parts. Cost: some ten places a sample, more only
/// where sheets are near.
std::optional<SplitSurface> sheets_apart(const geom::TriMesh& mesh, const Sizing& sizing,
                                         std::span<SurfaceSample> samples, const SheetOptions& options = {});

}  // namespace fpo
