#pragma once
// Geomview's OFF, binary form.

#include <cstddef>

#include "geom/mesh/trimesh.h"
#include "io/input_file.h"

namespace io {

/// What follows the header line, from byte `body` on: the numbers of vertices, facets and edges, the vertices
/// of three coordinates and `extras` more numbers each, the facets: how many corners, the corners, how many
/// colour components, the components. Every number has 4 bytes; reals are in single precision. Geomview
/// writes this in big-endian order, others in little-endian, and of these some (pmp-library) without any
/// colours nor their count. Which it is, is told by the content: the first of these three layouts that ends
/// where the file does. Polygons, and facets of one or two corners, as in parse_off().
/// Throws geom::InputError "name:byte offset: what". Cost: linear; nothing is stored before a layout has
/// explained the whole file. `repeated`: as in MeshBuilder::finish().
geom::TriMesh parse_binary_off(const InputFile& file, std::size_t body, std::size_t extras,
                               std::size_t* repeated);

}  // namespace io
