#pragma once
// Edges of a mesh that are parts of curves, while its vertices become fewer.

#include <algorithm>
#include <vector>

#include "geom/ids.h"

namespace fpo {

class CurveEdges {
 public:
  using VertexId = geom::VertexId;

  bool has(VertexId a, VertexId b) const { return std::ranges::find(beside(a), b) != beside(a).end(); }
  /// The other ends of those at v.
  const std::vector<VertexId>& beside(VertexId v) const {
    return v.index() < beside_.size() ? beside_[v] : none;
  }
  bool are_at(VertexId v) const { return !beside(v).empty(); }

  void add(VertexId a, VertexId b) {
    if (has(a, b)) return;
    if (const VertexId last = std::max(a, b); last.index() >= beside_.size())
      beside_.resize(last.index() + 1);
    beside_[a].push_back(b);
    beside_[b].push_back(a);
  }
  /// v comes in between.
  void split(VertexId a, VertexId b, VertexId v) {
    remove(a, b);
    add(a, v);
    add(v, b);
  }
  /// A vertex of no curve goes anywhere, one within a curve along it, unless what comes of it is there
  /// already; others stay.
  bool may_collapse(VertexId v, VertexId w) const {
    if (!are_at(v)) return true;
    const std::vector<VertexId>& ends = beside(v);
    return ends.size() == 2 && has(v, w) && !has(ends[0], ends[1]);
  }
  void collapse(VertexId v, VertexId w) {
    for (const VertexId end : std::vector<VertexId>(beside(v))) {
      remove(v, end);
      if (end != w) add(end, w);
    }
  }

 private:
  void remove(VertexId a, VertexId b) {
    std::erase(beside_[a], b);
    std::erase(beside_[b], a);
  }

  inline static const std::vector<VertexId> none{};
  geom::Table<VertexId, std::vector<VertexId>> beside_;
};

}  // namespace fpo
