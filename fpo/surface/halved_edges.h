#pragma once
// Vertices of a surface whose long edges are halved, and where they are halved.

#include <cstdint>
#include <unordered_map>

#include "fpo/surface/sizing.h"

namespace fpo {

/// The same for both directions of an edge.
std::uint64_t edge_key(geom::VertexId a, geom::VertexId b);

/// Long: more than `most` times the smaller of the wanted lengths at the ends. Middles are rounded to the
/// exact range (geom/mesh/scaling.h), and the wanted length there is the mean of those at the ends.
class HalvedEdges {
 public:
  HalvedEdges(const geom::TriMesh& mesh, const Sizing& sizing, double most);

  double length2(geom::VertexId a, geom::VertexId b) const {
    return (positions_[a] - positions_[b]).squaredNorm();
  }
  bool is_long(geom::VertexId a, geom::VertexId b) const;
  /// By how much the longest edge of the facet is longer than an edge may be, about.
  double excess(const geom::TriMesh::Facet& facet) const;

  /// The middle of an edge if that is long, else none. The same one whenever it is asked for, so that all
  /// facets at the edge halve it alike.
  geom::VertexId middle(geom::VertexId a, geom::VertexId b);
  /// A new vertex in the middle of an edge of one facet's parts.
  geom::VertexId middle_within(geom::VertexId a, geom::VertexId b);
  /// No facet has an edge that was halved any more.
  void forget_middles() { middles_.clear(); }

  const geom::Table<geom::VertexId, geom::Vec3>& positions() const { return positions_; }
  geom::Table<geom::VertexId, geom::Vec3> take_positions() { return std::move(positions_); }
  VertexField take_lengths() { return std::move(h_); }

 private:
  geom::Table<geom::VertexId, geom::Vec3> positions_;
  VertexField h_;
  double most_;
  std::unordered_map<std::uint64_t, geom::VertexId> middles_;  ///< by the ends of the edge
};

}  // namespace fpo
