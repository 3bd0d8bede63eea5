#include "geom/dual/frame_vertices.h"

#include <cmath>
#include <limits>

namespace geom {

void FrameVertices::follow() {
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    frame_.evaluate(Frame::Place(vertices_[k]), 0, vertices_[k]);
    vertices_[k].has_signs = false;
  }
}

FrameVertices::Slot FrameVertices::evaluate(VertexId v) {
  const auto slot = static_cast<Slot>(vertices_.size());
  slot_of_[v] = slot;
  Vertex& out = vertices_.add();
  out.id = v;
  frame_.evaluate(frame_.place_of({mesh_.position(v), mesh_.level(v), 0}), 0, out);
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

/// Nearer than the second one, it is so than all: rounding keeps the order of differences.
int FrameVertices::nearest(const Vertex& v) const {
  int nearest = 0;
  double least = v.g[0], second = std::numeric_limits<double>::infinity();
  for (int i = 1; i < frame_.size(); ++i) {
    const double g = v.g[i];
    if (g < least) nearest = i;
    second = std::min(second, std::max(g, least));
    least = std::min(least, g);
  }
  return second - least > 4 * v.error ? nearest : -1;
}

}  // namespace geom
