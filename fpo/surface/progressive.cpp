#include "fpo/surface/progressive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geom/check.h"

namespace fpo {

using geom::Vec3;

namespace {

constexpr std::size_t leaf_size = 8;
constexpr double nothing = -1;

/// A tree over points that knows who is farthest from those that are taken.
class Traversal {
 public:
  Traversal(std::span<const Vec3> points, std::span<const double> wanted)
      : points_(points),
        wanted_(wanted),
        order_(points.size()),
        distance_(points.size(), std::numeric_limits<double>::infinity()),
        taken_(points.size(), 0) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.emplace_back();
    build(0, 0, points.size());
  }

  void take(std::size_t i) {
    taken_[i] = 1;
    approach(0, points_[i]);
  }

  /// The point that is farthest in units of its length.
  std::size_t farthest() const {
    std::size_t at = 0;
    while (nodes_[at].child > 0) {
      const std::size_t c = nodes_[at].child;
      at = better(nodes_[c], nodes_[c + 1]) ? c : c + 1;
    }
    return nodes_[at].best;
  }

 private:
  struct Node {
    geom::Box3 box;
    std::size_t begin = 0, end = 0, child = 0;  ///< child 0: a leaf; the second child is next to the first
    double reach = 0;                           ///< largest distance of a point that is not taken
    double score = nothing;                     ///< the same over its length
    std::size_t best = 0;                       ///< whose
  };

  static bool better(const Node& a, const Node& b) {
    return a.score > b.score || (a.score == b.score && a.best < b.best);
  }

  void build(std::size_t at, std::size_t begin, std::size_t end) {
    nodes_[at].begin = begin, nodes_[at].end = end;
    for (std::size_t k = begin; k < end; ++k) nodes_[at].box.extend(points_[order_[k]]);
    if (end - begin > leaf_size) {
      Eigen::Index axis = 0;
      nodes_[at].box.sizes().maxCoeff(&axis);
      const std::size_t middle = begin + (end - begin) / 2;
      const auto first = order_.begin();
      std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                       first + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(end),
                       [&](std::size_t a, std::size_t b) {
                         return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
                       });
      const std::size_t child = nodes_.size();
      nodes_[at].child = child;
      nodes_.resize(child + 2);
      build(child, begin, middle);
      build(child + 1, middle, end);
    }
    summarise(nodes_[at]);
  }

  void summarise(Node& node) const {
    node.reach = 0, node.score = nothing;
    if (node.child > 0) {
      const Node &a = nodes_[node.child], &b = nodes_[node.child + 1];
      const Node& best = better(a, b) ? a : b;
      node.reach = std::max(a.reach, b.reach), node.score = best.score, node.best = best.best;
      return;
    }
    node.best = points_.size();
    for (std::size_t k = node.begin; k < node.end; ++k) {
      const std::size_t i = order_[k];
      if (taken_[i]) continue;
      node.reach = std::max(node.reach, distance_[i]);
      const double score = distance_[i] / wanted_[i];
      if (score > node.score || (score == node.score && i < node.best)) node.score = score, node.best = i;
    }
  }

  /// Distances are those to x as well.
  void approach(std::size_t at, const Vec3& x) {
    Node& node = nodes_[at];
    const bool holds_x = node.box.contains(x);
    if (!holds_x && node.box.exteriorDistance(x) >= node.reach) return;
    if (node.child > 0) {
      approach(node.child, x);
      approach(node.child + 1, x);
    } else {
      for (std::size_t k = node.begin; k < node.end; ++k)
        distance_[order_[k]] = std::min(distance_[order_[k]], (points_[order_[k]] - x).norm());
    }
    summarise(node);
  }

  std::span<const Vec3> points_;
  std::span<const double> wanted_;
  std::vector<std::size_t> order_;
  std::vector<double> distance_;
  std::vector<char> taken_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<std::size_t> progressive_ranks(std::span<const Vec3> points, std::span<const double> wanted) {
  geom::ensure(points.size() == wanted.size(), "one wanted length per point is needed");
  std::vector<std::size_t> ranks(points.size());
  if (points.empty()) return ranks;
  Traversal traversal(points, wanted);
  for (std::size_t rank = 0, next = 0; rank < points.size(); ++rank) {
    ranks[next] = rank;
    traversal.take(next);
    next = traversal.farthest();
  }
  return ranks;
}

}  // namespace fpo
