#pragma once
// From the vertices of a surface as it is remeshed to those of the file that it was read from.

#include <filesystem>
#include <vector>

#include "fpo/remesh/pipeline.h"
#include "geom/mesh/trimesh.h"
#include "io/surface_map.h"

namespace tools {

/// Of each place the first vertex of the file at the same place, to the bit. Cleaning keeps places;
/// a repair may make vertices that the file has not: for these none. O(V log V).
geom::Table<geom::VertexId, geom::VertexId> own_vertices(
    const geom::Table<geom::VertexId, geom::Vec3>& places,
    const geom::Table<geom::VertexId, geom::Vec3>& file);

/// Where the samples lie, by vertices of the file; samples on what a repair has made, by the nearest point of
/// the file's surface: how many these are is added to `elsewhere`. Throws geom::InputError if the file cannot
/// be read again. O((V + n) log V).
std::vector<io::MappedPoint> own_places(const std::filesystem::path& file, const geom::TriMesh& input,
                                        const std::vector<fpo::SurfaceSample>& samples,
                                        std::size_t& elsewhere);

}  // namespace tools
