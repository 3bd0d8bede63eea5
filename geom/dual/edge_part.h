#pragma once
// What the origin of a frame has of an edge of the surface, and who would have it without the origin.

#include <vector>

#include "geom/dual/frame_vertices.h"

namespace geom {

/// Where the origin's interval of the edge from u to v begins or ends: at the vertex, or where the origin is
/// as near as a site.
struct EdgePart {
  static constexpr int at_vertex = -1;
  int begin = at_vertex, end = at_vertex;
};

enum class Meets { no, yes, unsure };

/// Has the origin a part of the edge, and which?
Meets find_part(const FrameVertices::Vertex& u, const FrameVertices::Vertex& v, EdgePart& out);

/// The owners along that part without the origin, from u to v. False if something is not certain. Mostly
/// there is one.
bool find_owners(const FrameVertices& vertices, const FrameVertices::Vertex& u,
                 const FrameVertices::Vertex& v, const EdgePart& part, std::vector<int>& owners);

}  // namespace geom
