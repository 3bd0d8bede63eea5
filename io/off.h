#pragma once
// Geomview's OFF; binary files are only read.

#include <string>

#include "geom/mesh/trimesh.h"
#include "io/input_file.h"

namespace io {

/// Headers OFF, COFF, NOFF, STOFF and their mixtures ([ST][C][N]OFF); the counts follow on the same line,
/// with or without a blank before them, or on the next one; comments anywhere. Each vertex and each facet
/// begins a line; corners may go on in further lines, coordinates may not. What follows the coordinates or
/// the corners on their line (normals, colours) is ignored. Polygons are triangulated (polygon.h), facets of
/// one or two corners ignored. Behind "OFF BINARY\n" the rest is binary (binary_off.h).
/// Throws geom::InputError "name:line: what" or "name:byte offset: what". Cost: linear.
/// `repeated`: as in MeshBuilder::finish().
geom::TriMesh parse_off(const InputFile& file, std::size_t* repeated = nullptr);

/// Coordinates as the shortest decimals that read back exactly.
std::string to_off(const geom::TriMesh& mesh);

/// Whether a word is a header that parse_off reads, or one with the first count right behind.
bool is_off_header(std::string_view word);

}  // namespace io
