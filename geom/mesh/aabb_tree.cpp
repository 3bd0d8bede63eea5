#include "geom/mesh/aabb_tree.h"

#include <algorithm>
#include <utility>

#include "geom/check.h"

namespace geom {
namespace {

constexpr std::size_t leaf_size = 4;

/// In this order of summation here and for boxes: rounding is monotone, so a box is never farther than a
/// point in it.
double squared_length(double x, double y, double z) { return x * x + y * y + z * z; }
double squared_distance(const Vec3& a, const Vec3& b) {
  return squared_length(a.x() - b.x(), a.y() - b.y(), a.z() - b.z());
}

/// Where on a segment, from 0 at `a` to 1 at `b`, the point nearest to x lies.
double nearest_parameter(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  return length2 > 0 ? std::clamp((x - a).dot(d) / length2, 0.0, 1.0) : 0.0;
}

void improve_on_edge(const Vec3& x, const std::array<Vec3, 3>& q, std::size_t e, TrianglePoint& best) {
  const std::size_t f = e == 2 ? 0 : e + 1;
  const double t = nearest_parameter(x, q[e], q[f]);
  const Vec3 point = t == 0 ? q[e] : t == 1 ? q[f] : Vec3(q[e] + t * (q[f] - q[e]));
  const double d2 = squared_distance(x, point);
  if (!(d2 < best.distance2)) return;
  best.point = point;
  best.barycentric.setZero();
  best.barycentric[static_cast<Eigen::Index>(e)] = 1 - t;
  best.barycentric[static_cast<Eigen::Index>(f)] = t;
  best.distance2 = d2;
}

}  // namespace

// The foot of the perpendicular, if it has positive barycentric coordinates, else the nearest of the points
// of the three edges. The smaller the triangle's height, the less is known of those coordinates; but then the
// edges are near whatever lies between them, so for a needle all four are compared.
TrianglePoint closest_point(const Vec3& x, const std::array<Vec3, 3>& q) {
  TrianglePoint best;
  const Vec3 u = q[1] - q[0], v = q[2] - q[0], w = x - q[0], normal = u.cross(v);
  const double n2 = normal.squaredNorm();
  const double b1 = w.cross(v).dot(normal), b2 = u.cross(w).dot(normal), b0 = n2 - b1 - b2;
  const bool inside = n2 > 0 && b0 > 0 && b1 > 0 && b2 > 0;
  if (inside) {
    best.barycentric = Vec3(b0, b1, b2) / n2;
    best.point = q[0] + best.barycentric[1] * u + best.barycentric[2] * v;
    best.distance2 = squared_distance(x, best.point);
  }
  constexpr double needle = 1e-12;  // of sin^2 of the angle at q[0]
  if (!inside || n2 < needle * u.squaredNorm() * v.squaredNorm())
    for (std::size_t e = 0; e < 3; ++e) improve_on_edge(x, q, e, best);
  // Rounding may leave the box by a last bit.
  best.point = best.point.cwiseMax(q[0].cwiseMin(q[1]).cwiseMin(q[2]))
                   .cwiseMin(q[0].cwiseMax(q[1]).cwiseMax(q[2]))
                   .eval();
  best.distance2 = squared_distance(x, best.point);
  return best;
}

AabbTree::AabbTree(const TriMesh& mesh) : mesh_(mesh) {
  require(mesh.num_facets() > 0, "the mesh has no facet");
  std::vector<Item> items;
  items.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    Box3 box;
    for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
    items.push_back({box.center(), t});
  }
  build(items, 0);
  nodes_.shrink_to_fit();
  facets_.reserve(items.size());
  for (const Item& item : items) facets_.push_back(item.facet);
}

/// Halves the facets at the median of their middles, along the axis on which these spread most.
void AabbTree::build(std::span<Item> items, std::size_t first) {
  const std::size_t node = nodes_.size();
  const bool leaf = items.size() <= leaf_size;
  nodes_.push_back({Vec3(0, 0, 0), Vec3(0, 0, 0), leaf ? static_cast<std::int32_t>(items.size()) : 0,
                    static_cast<std::int32_t>(first)});
  Box3 box;
  if (leaf) {
    for (const Item& item : items)
      for (int i = 0; i < 3; ++i) box.extend(mesh_.corner(item.facet, i));
  } else {
    Box3 spread;
    for (const Item& item : items) spread.extend(item.middle);
    Eigen::Index axis = 0;
    spread.sizes().maxCoeff(&axis);
    const auto is_before = [&](const Item& a, const Item& b) {
      return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.facet < b.facet;
    };
    const std::size_t half = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     is_before);
    build(items.first(half), first);
    const std::size_t second = nodes_.size();
    nodes_[node].next = static_cast<std::int32_t>(second);
    build(items.subspan(half), first + half);
    for (const std::size_t child : {node + 1, second})
      box.extend(nodes_[child].low), box.extend(nodes_[child].high);
  }
  nodes_[node].low = box.min(), nodes_[node].high = box.max();
}

double AabbTree::distance2(const Node& node, const Vec3& x) {
  const auto outside = [&](int i) { return std::max({node.low[i] - x[i], 0.0, x[i] - node.high[i]}); };
  return squared_length(outside(0), outside(1), outside(2));
}

/// The same of the box of a facet.
double AabbTree::distance2(FacetId t, const Vec3& x) const {
  const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
  const auto outside = [&](int i) {
    return std::max({std::min({a[i], b[i], c[i]}) - x[i], 0.0, x[i] - std::max({a[i], b[i], c[i]})});
  };
  return squared_length(outside(0), outside(1), outside(2));
}

void AabbTree::improve(FacetId t, const Vec3& x, Closest& best) const {
  const TrianglePoint p = closest_point(x, triangle(t));
  if (p.distance2 < best.distance2 ||
      (p.distance2 == best.distance2 && (!best.facet.valid() || t < best.facet)))
    best = Closest{p, t};
}

// The tree is halved by count, so it has at most 32 levels, and each leaves one child on the stack.
void AabbTree::search(const Vec3& x, Closest& best, double enough) const {
  struct Waiting {
    std::size_t node;
    double distance2;
  };
  std::array<Waiting, 64> stack;
  std::size_t height = 0;
  stack[height++] = {0, distance2(nodes_[0], x)};
  while (height > 0) {
    Waiting at = stack[--height];
    if (at.distance2 > best.distance2) continue;
    while (nodes_[at.node].count == 0) {
      Waiting near{at.node + 1, 0}, far{static_cast<std::size_t>(nodes_[at.node].next), 0};
      near.distance2 = distance2(nodes_[near.node], x);
      far.distance2 = distance2(nodes_[far.node], x);
      if (far.distance2 < near.distance2) std::swap(near, far);
      if (far.distance2 <= best.distance2) stack[height++] = far;
      at = near;
      if (at.distance2 > best.distance2) break;
    }
    if (at.distance2 > best.distance2) continue;
    const Node& leaf = nodes_[at.node];
    for (std::int32_t k = leaf.next; k < leaf.next + leaf.count; ++k)
      if (const FacetId t = facets_[static_cast<std::size_t>(k)]; distance2(t, x) <= best.distance2)
        improve(t, x, best);
    if (best.distance2 < enough) return;
  }
}

void AabbTree::overlapping(const Box3& box, std::vector<FacetId>& facets) const {
  const auto meets = [&](const Vec3& low, const Vec3& high) {
    return (low.array() <= box.max().array()).all() && (high.array() >= box.min().array()).all();
  };
  std::array<std::size_t, 64> stack;
  std::size_t height = 0;
  stack[height++] = 0;
  while (height > 0) {
    const std::size_t at = stack[--height];
    const Node& node = nodes_[at];
    if (!meets(node.low, node.high)) continue;
    if (node.count == 0) {
      stack[height++] = at + 1;
      stack[height++] = static_cast<std::size_t>(node.next);
      continue;
    }
    for (std::int32_t k = node.next; k < node.next + node.count; ++k) {
      const FacetId t = facets_[static_cast<std::size_t>(k)];
      const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
      if (meets(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c))) facets.push_back(t);
    }
  }
}

bool AabbTree::is_nearer(const Vec3& x, double distance2, FacetId hint) const {
  Closest best;
  best.distance2 = distance2;
  if (hint.valid()) improve(hint, x, best);
  if (!(best.distance2 < distance2)) search(x, best, distance2);
  return best.distance2 < distance2;
}

AabbTree::Closest AabbTree::closest(const Vec3& x, FacetId hint) const {
  Closest best;
  if (hint.valid()) improve(hint, x, best);
  search(x, best);
  return best;
}

}  // namespace geom
