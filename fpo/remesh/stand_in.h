#pragma once
// A coarser surface to optimize on where the given one is made of needles.
//
// A facet that is longer than a cell is wide is clipped to many cells, and where thousands of such facets lie
// side by side (a disk of needles, a sphere by latitude and longitude stretched a thousand times) each cell
// is made of hundreds of pieces: a move costs milliseconds. What is finer than the spacing across the needles
// matters nothing to where samples go. So they are optimized on a surface without it and brought back. With
// longer edges the same serves where facets are far smaller than cells (coarse_start.h).

#include <cstddef>
#include <vector>

#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_sample.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// Whether n cells of that spacing are cut by needles: facets more than a spacing long count with their
/// length, and there must be more than 40 spacings of them a cell. Well-shaped facets are never so many, for
/// there is no room for them.
bool has_needles(const geom::TriMesh& surface, std::size_t n, double spacing);

/// In spacings: edges that are shorter are collapsed, none longer are made.
struct StandInEdges {
  double collapsed = 1.0 / 8, made = 1.0 / 6;
};

/// The surface with edges shorter than the spacing at a vertex collapsed into their other end, where the
/// surface stays near (each time within 1/50 of the spacing), of the same type and on its side, borders on
/// themselves. Vertices keep their ids and places, some are left without a facet. O(F) a pass over the edges,
/// some passes. Deterministic.
geom::TriMesh stand_in(const geom::TriMesh& surface, const VertexField& spacing,
                       const StandInEdges& edges = {});
/// The same spacing everywhere.
geom::TriMesh stand_in(const geom::TriMesh& surface, double spacing);

/// The points of the surface that are nearest to the samples of another one.
std::vector<SurfaceSample> brought_to(const geom::TriMesh& surface, std::vector<SurfaceSample> samples);
/// The same from a mesh near the surface, to what faces the same way as they do there where that is within
/// half an edge of the mesh: of sheets closer to each other than the mesh is to the surface, their own.
std::vector<SurfaceSample> brought_to(const geom::TriMesh& surface, std::vector<SurfaceSample> samples,
                                      const geom::TriMesh& from);

/// A remesh whose vertices are samples that were moved.
geom::TriMesh with_vertices_at(const std::vector<SurfaceSample>& samples, const geom::TriMesh& remesh);

}  // namespace fpo
