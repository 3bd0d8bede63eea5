#pragma once
// Wavefront OBJ.

#include <string>

#include "geom/mesh/trimesh.h"
#include "io/input_file.h"

namespace io {

/// Reads `v` (three coordinates; a w or colours after them are ignored) and `f` in the forms v, v/vt, v//vn
/// and v/vt/vn, with negative indices (counted back from the last vertex so far). Polygons are triangulated
/// (polygon.h). Points, lines, normals, texture coordinates, groups, materials and unknown statements are
/// ignored, so normals or UVs never split a vertex. A backslash at the end of a line continues it.
/// Throws geom::InputError "name:line: what". Cost: linear.
/// `repeated`: as in MeshBuilder::finish().
geom::TriMesh parse_obj(const InputFile& file, std::size_t* repeated = nullptr);

/// Statements v and f only; coordinates as the shortest decimals that read back exactly.
std::string to_obj(const geom::TriMesh& mesh);

}  // namespace io
