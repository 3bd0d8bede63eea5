#pragma once
// Triangle meshes in files: the extension decides the format, the content must agree.

#include <filesystem>

#include "geom/mesh/trimesh.h"

namespace io {

enum class MeshFormat { obj, off, ply, stl };

/// The format that a file name's extension means, in any case. Throws geom::InputError on another extension.
MeshFormat mesh_format(const std::filesystem::path& path);

/// Reads .obj, .off, .ply or .stl; the dialects are listed in obj.h, off.h, ply.h, stl.h. The mesh has at
/// least one facet, finite coordinates of at most 1e48, indices in range and three different vertices in each
/// facet. Throws geom::InputError of one line: "path: what", "path:line: what" or, in binary files,
/// "path:byte offset: what". Cost: linear in the file.
geom::TriMesh read_mesh(const std::filesystem::path& path);
/// The same, but facets that name a vertex twice are no fault: they are dropped, polygons but for that
/// corner. Their number is added to `repeated`.
geom::TriMesh read_mesh(const std::filesystem::path& path, std::size_t& repeated);

/// Writes the file atomically (atomic_file.h). OBJ, OFF (text) and PLY (binary) keep every bit of the
/// coordinates; STL (binary) keeps single precision and no vertex ids. Throws geom::InputError "cannot write
/// path: reason".
void write_mesh(const std::filesystem::path& path, const geom::TriMesh& mesh);
/// Throws what that would throw because its format cannot hold the mesh: what else belongs to it need not be
/// written then.
void require_mesh(const std::filesystem::path& path, const geom::TriMesh& mesh);
/// The same of a mesh with edges of about that length, where this surface is.
void require_edges(const std::filesystem::path& path, const geom::TriMesh& surface, double edge);

}  // namespace io
