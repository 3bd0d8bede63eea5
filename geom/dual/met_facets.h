#pragma once
// The facets that a cell is traced over (flood.h), each once.

#include <array>
#include <cstdint>
#include <span>

#include "geom/dual/frame_vertices.h"
#include "geom/dual/segment_ends.h"
#include "geom/reused.h"

namespace geom {

class MetFacets {
 public:
  using Slot = std::uint32_t;
  struct Facet {
    FacetId id;
    std::array<FrameVertices::Slot, 3> corners;
    std::array<bool, 3> done;  ///< edges
    SegmentEnds::List ends;
    /// The edge from u to v; 3 if there is none.
    std::size_t edge(FrameVertices::Slot u, FrameVertices::Slot v) const {
      std::size_t e = 0;
      while (e < 3 && !(corners[e] == u && corners[e == 2 ? 0 : e + 1] == v)) ++e;
      return e;
    }
  };

  /// Keeps a reference.
  explicit MetFacets(const TriMesh& mesh) : mesh_(mesh), slot_of_(mesh.num_facets(), 0) {}

  void clear() { facets_.clear(); }
  /// One that was not met before has no edge that is done, and no ends; its corners come with their signs.
  Slot meet(FacetId t, FrameVertices& vertices) { return has(t) ? slot_of_[t] : add(t, vertices); }

  bool has(FacetId t) const { return slot_of_[t] < facets_.size() && facets_[slot_of_[t]].id == t; }
  /// Of a facet that was met.
  Slot slot(FacetId t) const { return slot_of_[t]; }
  std::size_t size() const { return facets_.size(); }
  Facet& operator[](std::size_t slot) { return facets_[slot]; }
  const Facet& operator[](std::size_t slot) const { return facets_[slot]; }
  std::span<const Facet> items() const { return facets_.items(); }

 private:
  Slot add(FacetId t, FrameVertices& vertices);

  const TriMesh& mesh_;
  Reused<Facet> facets_;
  Table<FacetId, Slot> slot_of_;  ///< if that slot says so, too
};

}  // namespace geom
