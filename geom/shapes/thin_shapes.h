#pragma once
// Bodies with parts that are thinner than a few samples, unless there are very many: where a remesh easily
// loses its topological type. Rows of the table of shapes.h, which says what they are; built like its shapes.

#include "geom/mesh/trimesh.h"

namespace geom {

TriMesh plate(int size);           ///< facets have edges of 1/size
TriMesh comb(int size);            ///< each tooth cut in `size` along its length
TriMesh paper(int size);           ///< facets have edges of 1/size along the sheet
TriMesh touching_boxes(int size);  ///< each cut in `size` along each axis
TriMesh horn(int size);            ///< steps around, as for all that follow but shell, ears and pin-holes
TriMesh dumbbell(int size);
TriMesh narrow_torus(int size);
TriMesh thin_handle(int size);
TriMesh pinched_tube(int size);
TriMesh shell(int size);  ///< pieces along an edge of an icosahedron
TriMesh ears(int size);
TriMesh pin_holes(int size);

}  // namespace geom
