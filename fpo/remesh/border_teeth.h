#pragma once
// Teeth of borders: not in the paper, whose surfaces are closed or end smoothly.
//
//            v               The border of a scan follows whatever facets there were. Single facets stand
//           / \              out of it, with angles of their own; triangles that follow it have smaller ones.
//     --p--/   \--q--        A tooth is what is around a vertex v of the border if that is a small angle
//        \ |   | /           between short edges. Without it the border goes from p to q along the other
//         \|___|/            side of the facets of v.
//
// Of the same topological type: the facets of v are a disk, and but for p and q the vertices around it are
// inside the surface. So it has one arc in common with the rest, from p to q, and can be shrunk to that arc.

#include <vector>

#include "geom/mesh/trimesh.h"

namespace fpo {

struct Tooth {
  double longest;  ///< its border edges are shorter
  double angle;    ///< of the surface around its tip, at most; radians
};

/// The facets that are left without teeth of that kind, ascending. What is cut off may leave others, which
/// are cut off then. A tip is no tooth where the border turns by more than 90 degrees there, seen from twice
/// and from four times the longest edge away: a corner of the surface, however fine its facets are. Nor is it
/// one if its facets touch the border elsewhere, or if the part of the surface is smaller than eight squares
/// of that length. Where the surface meets itself in a vertex each side has a border of its own.
/// `surface` must have no edge with more than two facets, or with two that run through it the same way.
/// Deterministic. O(F + teeth * edges seen), a few times.
std::vector<geom::FacetId> without_teeth(const geom::TriMesh& surface, const Tooth& tooth);

}  // namespace fpo
