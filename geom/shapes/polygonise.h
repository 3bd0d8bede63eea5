#pragma once
// Triangles on an implicit surface, by its dual on a cubic lattice.

#include <functional>

#include "geom/mesh/trimesh.h"

namespace geom {

/// A smooth function whose zero set is the surface; negative inside.
struct ImplicitSurface {
  struct Sample {
    double value;
    Vec3 gradient;
  };
  std::function<Sample(const Vec3&)> at;
  Box3 box;  ///< holds the surface with some room around
};

/// The surface {value = 0} as a closed, oriented 2-manifold: one vertex for each loop in which the surface
/// leaves a lattice cell, one quadrilateral (two triangles) for each lattice edge that it crosses, then
/// rounds of smoothing within the surface and Newton steps back onto it. `cells` counts lattice cells along
/// the longest side of the box. Around a vertex its loop's quadrilaterals form one fan; an edge can have four
/// of them only where the surface passes a face twice and is one loop in both cells. Throws InputError there
/// (the lattice is too coarse for the surface), and where the surface reaches the box. Cost: O(cells^3)
/// evaluations.
TriMesh polygonised(const ImplicitSurface& surface, int cells);

}  // namespace geom
