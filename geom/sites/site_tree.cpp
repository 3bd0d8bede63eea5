#include "geom/sites/site_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geom/check.h"
#include "geom/one_sided_floats.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t leaf_capacity = 12;
constexpr int max_depth = 96;  // bounds the stack of a visit: two entries a level

double root(double x) { return x > 0 ? std::sqrt(x) : 0; }

}  // namespace

double SiteTree::distance2(const Vec3& x, const Entry& e) const {
  const double dx = x.x() - e.position[0], dy = x.y() - e.position[1], dz = x.z() - e.position[2];
  return dx * dx + dy * dy + dz * dz;
}

SiteTree::Entry SiteTree::entry_of(SiteId id, const WeightedPoint3& point) {
  const Vec3& x = point.position;
  return {{static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())},
          rounded_up(point.weight),
          nothing,
          id};
}

void SiteTree::know(SiteId id, const WeightedPoint3& point) {
  if (!all_points_) {
    if (id.index() >= points_.size()) points_.resize(id.index() + 1);
    points_[id] = point;
  }
  slack_ = std::max(slack_, 0x1p-22 * point.position.lpNorm<Eigen::Infinity>() + 1e-44);
}

SiteTree::NodeId SiteTree::leaf_of(const Entry& entry, int& depth) const {
  NodeId node(0);
  for (depth = 0; !nodes_[node].leaf(); ++depth) {
    const Node& inner = nodes_[node];
    const bool upper = entry.position[static_cast<std::size_t>(inner.axis)] >= inner.plane;
    node = NodeId(inner.child.value + upper);
  }
  return node;
}

void SiteTree::insert(SiteId id, const WeightedPoint3& point, SiteId) {
  if (id.index() >= places_.size()) places_.resize(id.index() + 1);
  ensure(!places_[id].node.valid(), "site tree: the site is already in");
  know(id, point);
  insert(entry_of(id, point));
}

void SiteTree::insert(const Entry& entry) {
  int depth = 0;
  const NodeId node = leaf_of(entry, depth);
  add(node, entry);
  if (leaves_[node].size() > leaf_capacity && depth < max_depth) split(node);
  raise(places_[entry.site].node, entry);
}

void SiteTree::add(NodeId node, const Entry& entry) {
  places_[entry.site] = {node, leaves_.push(node, entry)};
}

void SiteTree::remove(SiteId id) {
  const Place place = places_[id];
  if (const Entry moved = leaves_.erase(place.node, place.slot); moved.site.valid())
    places_[moved.site].slot = place.slot;
  places_[id] = {};
  refresh(place.node);
}

/// Mostly it stays in its leaf.
void SiteTree::move(SiteId id, const WeightedPoint3& point) {
  const Place place = places_[id];
  Entry& before = leaves_[place.node][place.slot];
  Entry entry = entry_of(id, point);
  entry.reach = before.reach;
  know(id, point);
  int depth = 0;
  if (leaf_of(entry, depth) == place.node) {
    const bool is_lighter = entry.weight < before.weight;
    before = entry;
    if (is_lighter)
      refresh(place.node);
    else
      raise(place.node, entry);
  } else {
    remove(id);
    insert(entry);
  }
}

void SiteTree::set_reach(SiteId j, double max_radius2) {
  const Place place = places_[j];
  Entry& entry = leaves_[place.node][place.slot];
  const float before = entry.reach;
  entry.reach = rounded_up(max_radius2);
  if (entry.reach >= before)
    raise(place.node, entry);
  else if (before == nodes_[place.node].max_reach)
    refresh(place.node);
}

/// Halves a leaf at the median of its longest side. Sites at one position cannot be told apart and stay
/// together.
void SiteTree::split(NodeId node) {
  const std::span<const Entry> old = std::as_const(leaves_)[node];
  const std::vector<Entry> entries(old.begin(), old.end());
  std::size_t axis = 0;
  float longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [least, most] =
        std::ranges::minmax(entries, {}, [&](const Entry& e) { return e.position[i]; });
    if (const float side = most.position[i] - least.position[i]; side > longest) longest = side, axis = i;
  }
  if (!(longest > 0)) return;
  std::vector<float> coordinates;
  coordinates.reserve(entries.size());
  for (const Entry& e : entries) coordinates.push_back(e.position[axis]);
  std::ranges::sort(coordinates);
  // The lower half must not be empty: a plane above the smallest coordinate, at the median if that is
  // possible.
  float plane = coordinates[coordinates.size() / 2];
  if (plane == coordinates.front()) plane = *std::ranges::upper_bound(coordinates, plane);

  const NodeId lower = nodes_.next_id(), upper(lower.value + 1);
  nodes_.resize(nodes_.size() + 2);
  nodes_[lower].parent = nodes_[upper].parent = node;
  nodes_[node].axis = static_cast<std::int32_t>(axis);
  nodes_[node].plane = plane;
  nodes_[node].child = lower;
  leaves_.clear(node);
  for (const Entry& e : entries) add(e.position[axis] >= plane ? upper : lower, e);
  refresh(lower);
  refresh(upper);
}

/// Raises the bounds of a node to those of an entry below it, and so on up as far as they change.
void SiteTree::raise(NodeId node, const Entry& entry) {
  for (; node.valid(); node = nodes_[node].parent) {
    Node& n = nodes_[node];
    if (entry.reach <= n.max_reach && entry.weight <= n.max_weight) return;
    n.max_reach = std::max(n.max_reach, entry.reach);
    n.max_weight = std::max(n.max_weight, entry.weight);
  }
}

/// Recomputes the bounds of a node from below and carries them up as far as they change.
void SiteTree::refresh(NodeId node) {
  for (; node.valid(); node = nodes_[node].parent) {
    Node& n = nodes_[node];
    float reach = nothing, weight = nothing;
    if (n.leaf()) {
      for (const Entry& e : leaves_[node])
        reach = std::max(reach, e.reach), weight = std::max(weight, e.weight);
    } else {
      const Node &low = nodes_[n.child], &high = nodes_[NodeId(n.child.value + 1)];
      reach = std::max(low.max_reach, high.max_reach), weight = std::max(low.max_weight, high.max_weight);
    }
    if (reach == n.max_reach && weight == n.max_weight) return;
    n.max_reach = reach, n.max_weight = weight;
  }
}

/// The squared distance within which a rounded position can be if that of its site is `reach`. With room for
/// the rounding of the distances, which were computed from coordinates within a few ulps of each other or of
/// a corner whose error is of that order.
double SiteTree::limit2(double reach) const {
  const double far = reach + slack_;
  return far * far * (1 + 1e-9) + 1e-300;
}

/// From the leaf where x belongs up to the root, and down into those siblings on the way that are near
/// enough.
template <class Limit2, class OnEntry>
void SiteTree::visit(const Vec3& x, Limit2 limit2, OnEntry on_entry) const {
  const double widest = limit2(nodes_[NodeId(0)]);
  const auto look_into = [&](NodeId leaf, double leaf_limit2) {
    if (leaf_limit2 < 0) return;
    for (const Entry& e : leaves_[leaf])
      if (const double d2 = distance2(x, e); d2 <= leaf_limit2) on_entry(e, d2);
  };
  NodeId node(0);
  while (!nodes_[node].leaf())
    node = NodeId(nodes_[node].child.value + (x[nodes_[node].axis] >= nodes_[node].plane));
  look_into(node, limit2(nodes_[node]));

  std::array<Visit, max_depth + 2> stack;
  for (NodeId parent = nodes_[node].parent; parent.valid(); node = parent, parent = nodes_[node].parent) {
    const Node& split = nodes_[parent];
    std::size_t size = 0;
    stack[0] = {NodeId(2 * split.child.value + 1 - node.value), {0, 0, 0}};  // the sibling
    stack[0].gap[static_cast<std::size_t>(split.axis)] = x[split.axis] - split.plane;
    if (stack[0].distance2() <= widest) size = 1;
    while (size > 0) {
      const Visit v = stack[--size];
      const Node& at = nodes_[v.node];
      const double at_limit2 = limit2(at);
      if (v.distance2() > at_limit2) continue;
      if (at.leaf()) {
        look_into(v.node, at_limit2);
        continue;
      }
      const double d = x[at.axis] - at.plane;
      Visit far = v;
      far.gap[static_cast<std::size_t>(at.axis)] = d;
      far.node = NodeId(at.child.value + (d < 0));
      if (far.distance2() <= at_limit2) stack[size++] = far;
      stack[size++] = {NodeId(at.child.value + (d >= 0)), v.gap};
    }
  }
}

void SiteTree::rivals(SiteId p, std::vector<SiteId>& out) const {
  const std::size_t first = out.size();
  rivals(point_of(p), out);
  out.erase(std::remove(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(), p), out.end());
}

void SiteTree::rivals(const WeightedPoint3& own, std::vector<SiteId>& out) const {
  rivals_beyond(nothing, own, out);
}

void SiteTree::rivals_beyond(double least, const WeightedPoint3& own, std::vector<SiteId>& out) const {
  if (nodes_[NodeId(0)].max_reach <= least) return;
  const auto limit2_of = [&](double reach, double weight) {
    const double rho2 = reach + own.weight;
    return reach <= least || rho2 < 0 ? -1 : limit2(root(rho2) + root(reach + weight));
  };
  visit(
      own.position, [&](const Node& node) { return limit2_of(node.max_reach, node.max_weight); },
      [&](const Entry& e, double distance2) {
        if (distance2 <= limit2_of(e.reach, e.weight)) out.push_back(e.site);
      });
}

void SiteTree::heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const {
  float known_weight = nothing;  // mostly many have the same
  double known_limit2 = -1;
  const auto limit2_of = [&](float weight) {
    if (weight != known_weight) {
      const double rho2 = vacancy.max_radius2 + weight;
      known_limit2 = rho2 < 0 ? -1 : limit2(vacancy.radius + root(rho2));
      known_weight = weight;
    }
    return known_limit2;
  };
  visit(
      vacancy.center, [&](const Node& node) { return limit2_of(node.max_weight); },
      [&](const Entry& e, double distance2) {
        if (distance2 <= limit2_of(e.weight)) out.push_back(e.site);
      });
}

/// What lies within slack of the best must be computed in doubles: (d - slack)^2 >= d^2 (1 - e) - slack^2 /
/// e.
NeighbourOracle::Nearest SiteTree::nearest(const Location3& x, SiteId without, SiteId) const {
  constexpr double e = 0x1p-10;
  const double allowance = slack_ * slack_ / e;
  Nearest best{SiteId(), infinity};
  const auto limit2_of = [&](double weight) {
    return best.site.valid() ? (best.radius2 + weight + allowance) * (1 + 2 * e) : infinity;
  };
  visit(
      x.position, [&](const Node& node) { return limit2_of(node.max_weight); },
      [&](const Entry& entry, double distance2) {
        if (entry.site == without || distance2 > limit2_of(entry.weight)) return;
        const double radius2 = power(x, point_of(entry.site));
        if (radius2 < best.radius2 || (radius2 == best.radius2 && entry.site < best.site) ||
            !best.site.valid())
          best = {entry.site, radius2};
      });
  return best;
}

void SiteTree::check() const {
  for (SiteId id(0); id.index() < places_.size(); id = SiteId(id.value + 1)) {
    const Place place = places_[id];
    if (!place.node.valid()) continue;
    const Entry& e = leaves_[place.node][place.slot];
    ensure(e.site == id, "site tree: a place names another site");
    const WeightedPoint3& point = point_of(id);
    ensure(distance2(point.position, e) < slack_ * slack_ && point.weight <= e.weight,
           "site tree: an entry is not the site rounded");
    for (NodeId child = place.node, node = nodes_[child].parent; node.valid();
         child = node, node = nodes_[node].parent) {
      const Node& n = nodes_[node];
      ensure(child.value == n.child.value + (e.position[static_cast<std::size_t>(n.axis)] >= n.plane),
             "site tree: a site is on the wrong side of a plane");
    }
    for (NodeId node = place.node; node.valid(); node = nodes_[node].parent)
      ensure(e.reach <= nodes_[node].max_reach && e.weight <= nodes_[node].max_weight,
             "site tree: a node's bound is below a site's");
  }
}

}  // namespace geom
