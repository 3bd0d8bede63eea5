#pragma once
// Vertices of the surface as a frame sees them: what it tells of each is computed once.

#include <cstdint>

#include "geom/dual/frame.h"
#include "geom/mesh/trimesh.h"
#include "geom/reused.h"

namespace geom {

class FrameVertices {
 public:
  using Slot = std::uint32_t;
  struct Vertex : Frame::Values {
    VertexId id;
    bool has_signs;                                ///< these are known:
    bool sure;                                     ///< of the signs of all g_i
    std::uint32_t beaten_by;                       ///< bit i: g_i < 0
    bool owned() const { return beaten_by == 0; }  ///< the origin is nearest
  };

  /// Keeps references.
  FrameVertices(const TriMesh& mesh, const Frame& frame)
      : mesh_(mesh), frame_(frame), slot_of_(mesh.num_vertices(), 0) {}

  /// The frame has begun anew: none is known.
  void clear() { vertices_.clear(); }
  /// The frame has one more site: what is known, is of it, too.
  void follow();

  /// Valid until clear(). A reference is, until the next call.
  Slot at(VertexId v) {
    const Slot slot = slot_of_[v];
    if (slot < vertices_.size() && vertices_[slot].id == v) return slot;
    return evaluate(v);
  }
  const Vertex& operator[](Slot s) const { return vertices_[s]; }
  /// The same with all signs.
  Slot with_signs(VertexId v) {
    const Slot slot = at(v);
    if (!vertices_[slot].has_signs) find_signs(vertices_[slot]);
    return slot;
  }
  const Frame& frame() const { return frame_; }
  /// The site of least g_i, if that is certain; else -1.
  int nearest(const Vertex& v) const;
  std::size_t size() const { return vertices_.size(); }

 private:
  Slot evaluate(VertexId v);
  void find_signs(Vertex& v) const;

  const TriMesh& mesh_;
  const Frame& frame_;
  Reused<Vertex> vertices_;
  Table<VertexId, Slot> slot_of_;  ///< if that slot says so, too
};

}  // namespace geom
