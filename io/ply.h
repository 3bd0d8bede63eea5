#pragma once
// PLY (Stanford polygon format).

#include <cstdint>
#include <string>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "geom/vec.h"
#include "io/input_file.h"
#include "io/ply_header.h"

namespace io {

/// A number of every vertex.
struct VertexProperty {
  std::string name;
  PlyType type;
  std::vector<double> values;
};

/// Text and binary of both byte orders, all number types, any further elements and properties (lists too).
/// The element "vertex" must have x, y, z; the corners of "face" are the list vertex_indices or vertex_index.
/// Polygons are triangulated (polygon.h), faces of one or two corners ignored. Such a list of "tristrips" is
/// triangle strips, one after another with -1 between them.
/// Throws geom::InputError "name:line: what" or "name:byte offset: what". Cost: linear.
/// `repeated`: as in MeshBuilder::finish().
geom::TriMesh parse_ply(const InputFile& file, std::size_t* repeated = nullptr);

/// The vertices alone, with the property "weight" where there is one (else 0); faces need not exist.
std::vector<geom::WeightedPoint3> parse_ply_points(const InputFile& file);

/// What a face says of its corners.
struct PlyFace {
  std::vector<std::int64_t> corners;  ///< numbers of vertices, which need not exist
  std::vector<double> texture;        ///< its list `texcoord`: two numbers a corner, or of any other length
};
/// The faces as they stand, if they have lists `texcoord` of real numbers; else none.
std::vector<PlyFace> parse_ply_faces(const InputFile& file);

/// Every number of the vertices but x, y, z, as it stands; lists are passed over.
std::vector<VertexProperty> parse_ply_properties(const InputFile& file);

/// Binary, little-endian, coordinates in double precision.
std::string to_ply(const geom::TriMesh& mesh);

/// Vertices only; with a property "weight" if any weight is not 0.
std::string to_ply(const std::vector<geom::WeightedPoint3>& points);

}  // namespace io
