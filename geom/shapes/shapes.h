#pragma once
// Synthetic surfaces by name, for tests, demonstrations and timings.
//
//   name          Euler  components  loops  genus  what
//   sphere           2       1        0      0     radius 1, subdivided icosahedron
//   torus            0       1        0      1     radii 1 and 0.4
//   double-torus    -2       1        0      2     two tori melted together, smooth
//   blob             2       1        0      0     smooth random star-shaped body (--seed)
//   two-spheres      4       2        0      0     radius 1 each, a gap of 1/1000 between them
//   cube             2       1        0      0     side 1
//   l-block          2       1        0      0     flat sides, one reentrant edge
//   frame            0       1        0      1     square block with a square hole
//   thin-plate       2       1        0      0     1 x 1 x 1/500
//   cylinder         2       1        0      0     with flat caps; two circular creases
//   cone             2       1        0      0     sharp tip, flat base
//   joint            0       1        0      1     turned part: flange, collar and bore; circular creases
//   wedge, star, gear, hole-plate, shaft, rib, cone-plate, two-cylinders, screw: see machined_shapes.h
//   square           1       1        1      0     flat, side 1
//   triangle         1       1        1      0     flat, equilateral
//   wave-disk        1       1        1      0     disk with waves
//   tube             0       1        2      0     cylinder without caps
//   moebius          0       1        1      -     one-sided strip: cannot be oriented
//
// With parts thinner than a few samples, unless there are very many (thin_shapes.h):
//   plate            2       1        0      0     1 x 1 x 1/40
//   paper            2       1        0      0     1 x 1 x 1/100, in waves
//   comb             2       1        0      0     12 teeth, 1/50 thick
//   horn             2       1        0      0     ball of radius 1 with a horn that ends in nothing
//   ears             2       1        0      0     ball with two thin lobes
//   dumbbell         2       1        0      0     two balls of radius 1, joined by a bar of radius .03
//   narrow-torus     0       1        0      1     radii 1 and .97: a hole of radius .03
//   thin-handle      0       1        0      1     a ring that is 1 thick on one side and .06 on the other
//   pinched-tube     2       1        0      0     closed tube, pressed flat in the middle: .03 thick
//   shell            4       2        0      0     cavity in a ball: a wall of .02 to .14
//   pin-holes       -3       1        5      0     sphere with five holes of a facet each
//   boxes            4       2        0      0     two that touch in a part of a side

#include <cstdint>
#include <span>
#include <string_view>

#include "geom/mesh/trimesh.h"

namespace geom {

/// What holds for a shape at every size: a row of the table above.
struct ShapeInfo {
  std::string_view name, what;
  int size;  ///< the default
  int max_size;
  long euler;
  std::size_t components, boundary_loops;
  bool orientable = true;
};

std::span<const ShapeInfo> shape_table();

/// The row of a name. Throws InputError if there is none.
const ShapeInfo& shape_info(std::string_view name);

/// Builds a shape. `size` (0: the default) is the fineness: facets grow as its square, whatever it counts -
/// pieces along an edge (sphere, blob, flat-sided and flat shapes), steps around (turned and swept ones), or
/// lattice cells along the longest side (double-torus). Throws InputError if the name is unknown or the size
/// out of range: 1 (turned and swept shapes 3, double-torus 12) to max_size. Deterministic.
TriMesh make_shape(std::string_view name, int size = 0, std::uint64_t seed = 1);

/// The mesh turned by an angle that no coordinate plane is used to: flat sides end up coplanar but for
/// rounding.
TriMesh tilted(const TriMesh& mesh);

}  // namespace geom
