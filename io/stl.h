#pragma once
// STL (stereolithography), text and binary.

#include <string>

#include "geom/mesh/trimesh.h"
#include "io/input_file.h"

namespace io {

/// Vertices are welded where all three coordinates are equal numbers (-0 equals +0), numbered as they first
/// appear; a facet left with a repeated corner is dropped. The stored normals are ignored. Text may hold
/// several solids: all their facets are read. The kind is told by the content: binary if the facet count at
/// byte 80 explains the file's size exactly, else text if it starts with "solid" and holds no control
/// characters. Throws geom::InputError "name:line: what" or "name:byte offset: what". Cost: linear.
geom::TriMesh parse_stl(const InputFile& file);

/// Throws what to_stl() would throw.
void require_stl(const geom::TriMesh& mesh);
/// Throws what that would for edges of about that length on this surface.
void require_stl_edges(const geom::TriMesh& surface, double edge);
/// Binary. STL stores single precision: coordinates lose digits. Throws geom::InputError (no file name) on a
/// coordinate beyond single precision, and if its steps are more than a fiftieth of the mean edge: vertices
/// would move by a hundredth of it, or become equal, and be welded when read back.
std::string to_stl(const geom::TriMesh& mesh);

/// Whether the bytes are those of a binary STL file, by count and size.
bool is_binary_stl(std::string_view bytes);

}  // namespace io
