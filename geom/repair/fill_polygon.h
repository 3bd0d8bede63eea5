#pragma once
// Polygons in space filled with triangles.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "geom/vec.h"

namespace geom {

/// A hole's rim: its corners in order, the outer normals (of unit length, or 0 if there is none) of the
/// facets across its sides (side i joins corners i and i + 1), and which corners must not be joined.
struct PolygonRim {
  std::span<const Vec3> corners;
  std::span<const Vec3> across;
  std::function<bool(std::size_t, std::size_t)> forbidden;
};

/// The triangles over corner numbers, n - 2 of them, each turning like the polygon, that bend least against
/// one another and the facets across (the sharpest bend counts, in steps), and among those have the least
/// area (Liepa, Filling holes in meshes, 2003). Up to 200 corners by dynamic programming, O(n^3); beyond, the
/// ear that fits best is cut off until few enough are left, O(n^2). Empty if forbidden edges leave no way.
std::vector<std::array<std::size_t, 3>> filled(const PolygonRim& rim);

}  // namespace geom
