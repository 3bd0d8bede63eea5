#pragma once
// Gives equal positions one vertex.

#include <cstddef>
#include <vector>

#include "io/mesh_builder.h"

namespace io {

/// A hash table (open addressing, at most half full) over the vertices of a mesh under construction.
/// Positions are equal if their coordinates are equal numbers: -0 equals +0, and is stored as +0. Ids follow
/// first appearance. Cost: O(1) expected per look-up.
class VertexWelder {
 public:
  explicit VertexWelder(MeshBuilder& mesh) : mesh_(&mesh), slots_(1024) {}

  /// The vertex at `position`, added to the mesh (which may throw, naming `place`) if it is new.
  geom::VertexId id_of(const geom::Vec3& position, std::size_t place);

 private:
  std::size_t slot_of(const geom::Vec3& position) const;
  void grow();

  MeshBuilder* mesh_;
  std::vector<geom::VertexId> slots_;  ///< a power of two of them; none: free
};

}  // namespace io
