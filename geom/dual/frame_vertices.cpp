#include "geom/dual/frame_vertices.h"

#include <cmath>
#include <limits>

namespace geom {

void FrameVertices::follow() {
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    frame_.evaluate(vertices_[k].y, 0, vertices_[k]);
    vertices_[k].has_signs = false;
  }
}

FrameVertices::Slot FrameVertices::evaluate(VertexId v) {
  const auto slot = static_cast<Slot>(vertices_.size());
  slot_of_[v] = slot;
  Vertex& out = vertices_.add();
  out.id = v;
  frame_.evaluate(mesh_.position(v) - frame_.origin().position, 0, out);
  out.has_signs = false;
  return slot;
}

void FrameVertices::find_signs(Vertex& v) const {
  double closest_to_0 = std::numeric_limits<double>::infinity();
  v.beaten_by = 0;
  for (int i = 0; i < frame_.size(); ++i) {
    v.beaten_by |= static_cast<std::uint32_t>(v.g[i] < 0) << i;
    closest_to_0 = std::min(closest_to_0, std::abs(v.g[i]));
  }
  v.sure = closest_to_0 > v.error;
  v.has_signs = true;
}

int FrameVertices::nearest(const Vertex& v) const {
  int nearest = 0;
  for (int i = 1; i < frame_.size(); ++i)
    if (v.g[i] < v.g[nearest]) nearest = i;
  for (int i = 0; i < frame_.size(); ++i)
    if (i != nearest && !v.nearer(nearest, i)) return -1;
  return nearest;
}

}  // namespace geom
