#include "geom/dual/segment_ends.h"

#include <limits>

namespace geom {
namespace {

constexpr std::int32_t unlinked = std::numeric_limits<std::int32_t>::min();

}  // namespace

void SegmentEnds::clear() {
  links_.clear();
  links_of_corners_.clear();
  ends_.clear();
}

SegmentEnds::Node SegmentEnds::add_point() {
  links_.add({unlinked, unlinked});
  return static_cast<Node>(links_.size()) - 1;
}

SegmentEnds::Node SegmentEnds::add_corner() {
  links_of_corners_.add(unlinked);
  return -static_cast<Node>(links_of_corners_.size());
}

void SegmentEnds::link(Node from, Node to) {
  if (from < 0) {
    links_of_corners_[static_cast<std::size_t>(-1 - from)] = to;
  } else {
    std::array<Node, 2>& links = links_[static_cast<std::size_t>(from)];
    (links[0] == unlinked ? links[0] : links[1]) = to;
  }
}

bool SegmentEnds::join(List list) {
  int waiting = 0;
  ++stamp_;
  for (List e = list; e >= 0; e = ends_[static_cast<std::size_t>(e)].next) {
    const auto& [label, node, next] = ends_[static_cast<std::size_t>(e)];
    Waiting& other = waiting_[static_cast<std::size_t>(label)];
    if (other.stamp != stamp_) {
      other = {stamp_, node, false};
      ++waiting;
      continue;
    }
    if (other.is_joined) return false;
    other.is_joined = true;
    --waiting;
    link(node, other.node);
    link(other.node, node);
  }
  return waiting == 0;
}

/// Each chain from both of its ends.
bool SegmentEnds::are_all_on_chains() const {
  std::size_t passed = 0;
  for (std::size_t i = 0; i < links_of_corners_.size(); ++i) {
    Node before = -1 - static_cast<Node>(i), at = links_of_corners_[i];
    while (at >= 0) {
      if (++passed > 2 * links_.size()) return false;
      const auto& [one, two] = links_[static_cast<std::size_t>(at)];
      const Node onward = one == before ? two : one;
      if (onward == unlinked) return false;
      before = at;
      at = onward;
    }
  }
  return passed == 2 * links_.size();
}

}  // namespace geom
