#pragma once
// Places of the domain as differential domain analysis sees them, and the vector between two of them.

#include <cmath>
#include <optional>

#include "geom/vec.h"

namespace fpo {

/// A sample, or a point that stands for a piece of the domain. The plane is z = 0 with normal (0, 0, 1).
struct SpectrumPoint {
  geom::Vec3 position{0, 0, 0};
  geom::Vec3 normal{0, 0, 1};  ///< of length 1
  double spacing = 1;  ///< r: of a hexagonal arrangement with the local density, sqrt(2 / (sqrt(3) density))
};

/// A place and how many samples it stands for: 1 for a sample, the number of samples to expect there for a
/// piece of the domain.
struct SpectrumMass {
  SpectrumPoint at;
  double mass = 1;
};

/// Two directions that span the tangent plane: `first` is the tangential part of the x axis (near places
/// where that is normal to the surface, of the y axis), `second` is a left turn from it. In the plane z = 0:
/// x and y.
struct TangentFrame {
  geom::Vec3 first, second;
  explicit TangentFrame(const geom::Vec3& normal) {
    const geom::Vec3 axis = std::abs(normal.x()) < 0.995 ? geom::Vec3::UnitX() : geom::Vec3::UnitY();
    first = (axis - axis.dot(normal) * normal).normalized();
    second = normal.cross(first);
  }
};

/// The length of the curve on the surface from a to b, judged by the normals there (Bowers et al. 2010):
/// |d| (asin c1 - asin c2) / (c1 - c2), c = normal.d / |d| at either end, and |d| / sqrt(1 - c^2) where they
/// are equal. Exact on spheres and in planes. Never less than |d|; infinite along a normal.
double surface_length(const SpectrumPoint& a, const SpectrumPoint& b);

/// The differential from a to b (Wei, Wang 2011): in the direction of the tangential part of b - a, as long
/// as surface_length() in units of the mean spacing of the two. Nothing for places on sheets that face away
/// from each other (normals at more than 90 degrees), for equal places, and straight above each other.
std::optional<geom::Vec2> differential(const SpectrumPoint& a, const TangentFrame& frame_of_a,
                                       const SpectrumPoint& b);

}  // namespace fpo
