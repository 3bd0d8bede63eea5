#pragma once
// Segments of edges of the diagram, known by their ends: put together facet by facet, and shown to be all
// (flood.h).

#include <array>
#include <cstdint>
#include <utility>

#include "geom/dual/frame.h"
#include "geom/reused.h"

namespace geom {

class SegmentEnds {
 public:
  /// Where segments end: a point on an edge of the surface, which has two, or a circle or old corner
  /// (negative).
  using Node = std::int32_t;
  /// The ends on a facet.
  using List = std::int32_t;
  static constexpr List empty = -1;

  void clear();
  Node add_point();
  Node add_corner();
  /// An end of a segment between sites i and j of the frame (none: the origin).
  void add(List& list, int i, int j, Node node) {
    ends_.add({i < j ? i * num_names + j : j * num_names + i, node, list});
    list = static_cast<List>(ends_.size()) - 1;
  }
  /// Joins the two ends of each pair of sites on a facet. False unless there are two of each.
  bool join(List list);
  /// After all: does each chain of segments end, and is every point on one?
  bool are_all_on_chains() const;

 private:
  struct End {
    std::int32_t label;
    Node node;
    List next;
  };
  /// The first end of a label, until there is the second.
  struct Waiting {
    std::uint32_t stamp = 0;
    Node node = 0;
    bool is_joined = false;
  };
  static constexpr int num_names = Frame::most + 1;  ///< of sites and the origin

  void link(Node from, Node to);

  Reused<End> ends_;
  Reused<std::array<Node, 2>> links_;  ///< of each point: the other ends of its segments
  Reused<Node> links_of_corners_;      ///< of each corner: that of its segment
  std::array<Waiting, num_names * num_names> waiting_;
  std::uint32_t stamp_ = 0;
};

}  // namespace geom
