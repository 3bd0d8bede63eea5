#pragma once
// Test surfaces like machined parts: creases that come close to each other or meet at small angles, fillets,
// curves where smooth parts meet. Rows of the table in shapes.h; all closed, of one component.
//
//   name            Euler  what
//   wedge             2    prism over a triangle with an angle of 15 degrees
//   star              2    prism over a star with five tips of 26 degrees
//   gear              0    16 teeth and a bore
//   hole-plate      -22    two rows of six holes, a twentieth of a cell from the border
//   shaft             2    stepped, with fillets of a fiftieth in the reentrant steps
//   rib               2    L-block with a thin triangular rib
//   cone-plate        2    cone on a round plate, sharp tip
//   two-cylinders     2    one grows out of the side of the other: a crease that is no plane curve
//   screw             2    a thread that fades out at both ends
//
// What `size` counts: pieces of each edge (wedge, star, rib), of each facet's edges (gear, hole-plate), steps
// around (shaft, cone-plate, screw), a twelfth of them (two-cylinders).

#include "geom/mesh/trimesh.h"

namespace geom {

TriMesh wedge(int size);
TriMesh star(int size);
TriMesh gear(int size);
TriMesh hole_plate(int size);
TriMesh shaft(int size);
TriMesh rib(int size);
TriMesh cone_plate(int size);
TriMesh two_cylinders(int size);
TriMesh screw(int size);

}  // namespace geom
