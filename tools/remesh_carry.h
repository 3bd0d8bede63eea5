#pragma once
// What the input's vertices carry, on those of the remesh.

#include <string>

#include "tools/remesh_arguments.h"

namespace tools {

/// The remesh as a file of a.output's format. With --carry it has the input's vertex colours, scalar vertex
/// properties (PLY) and texture coordinates, interpolated where each sample lies; each triangle has the
/// texture coordinates of the chart in which its middle lies, so that none smears over a seam. What the
/// format cannot hold, and all of it without --carry, is named in a line: `dropped`, empty if nothing is.
/// Throws geom::InputError.
void write_remesh(const RemeshArguments& a, const geom::TriMesh& input, const fpo::RemeshResult& result,
                  std::string& dropped);

/// --map: where the vertices lie, by vertices of the file.
void write_map(const RemeshArguments& a, const geom::TriMesh& input, const fpo::RemeshResult& result);

}  // namespace tools
