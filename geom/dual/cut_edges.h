#pragma once
// Edges of the diagram that a new cell cuts: what is left of them ends in its circles.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/dual/state.h"

namespace geom {

/// One object serves many cells, one after the other.
class CutEdges {
 public:
  explicit CutEdges(DualState& state) : state_(state) {}

  /// These circles are going: those beyond them lose what is beyond.
  void cut(std::span<const CircleId> beaten);
  /// The new circles of p (`created`, in the order of `found`) and those at the other ends of the edges that
  /// leave p's cell there get to know each other.
  void connect(SiteId p, std::span<const EmptyCircle> found, std::span<const CircleId> created);

 private:
  /// A side of a circle, with the sites of the edge that leaves there.
  struct OpenSide {
    CircleId circle;
    std::uint8_t side;
    SiteId a, b;
  };
  void join(const OpenSide& from, CircleId to);
  CircleId circle_at(FacetId t, SiteId a, SiteId b, CircleId but) const;
  CircleId other_end(const OpenSide& from) const;
  bool is_taken(FacetId t, int edge, SiteId a, SiteId b, SiteId p) const;

  DualState& state_;
  std::vector<OpenSide> cut_off_;   ///< of circles that have lost what was beyond
  std::vector<OpenSide> outwards_;  ///< of new circles
};

}  // namespace geom
