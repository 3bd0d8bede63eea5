#include "geom/site_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t leaf_capacity = 12;
constexpr int max_depth = 96;  // bounds the stack of a visit: two entries a level

double root(double x) { return x > 0 ? std::sqrt(x) : 0; }

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return f < x ? std::nextafterf(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

double SiteTree::distance2(const Vec3& x, const Entry& e) const {
  const double dx = x.x() - e.position[0], dy = x.y() - e.position[1], dz = x.z() - e.position[2];
  return dx * dx + dy * dy + dz * dz;
}

/// Can the distance of a site be `reach` if that of its rounded position is this? With room for the rounding of
/// the distances, which were computed from coordinates within a few ulps of each other or of a corner whose
/// error is of that order.
bool SiteTree::within(double distance2, double reach) const {
  const double far = reach + slack_;
  return distance2 <= far * far * (1 + 1e-9) + 1e-300;
}

void SiteTree::insert(SiteId id, const WeightedPoint3& point, SiteId) {
  if (id.index() >= places_.size()) {
    places_.resize(id.index() + 1);
    points_.resize(id.index() + 1);
  }
  ensure(!places_[id].node.valid(), "site tree: the site is already in");
  points_[id] = point;
  slack_ = std::max(slack_, 0x1p-22 * point.position.lpNorm<Eigen::Infinity>() + 1e-44);
  Entry entry{{}, rounded_up(point.weight), nothing, id};
  for (int i = 0; i < 3; ++i)
    entry.position[static_cast<std::size_t>(i)] = static_cast<float>(point.position[i]);
  NodeId node(0);
  int depth = 0;
  for (; !nodes_[node].leaf(); ++depth) {
    const Node& inner = nodes_[node];
    const bool upper = entry.position[static_cast<std::size_t>(inner.axis)] >= inner.plane;
    node = NodeId(inner.child.value + upper);
  }
  add(node, entry);
  if (leaves_[node].size() > leaf_capacity && depth < max_depth) split(node);
  refresh(places_[id].node);
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

void SiteTree::set_reach(SiteId j, double max_radius2) {
  const Place place = places_[j];
  float& reach = leaves_[place.node][place.slot].reach;
  const float before = reach;
  reach = rounded_up(max_radius2);
  if (reach >= before)
    for (NodeId i = place.node; i.valid() && nodes_[i].max_reach < reach; i = nodes_[i].parent)
      nodes_[i].max_reach = reach;
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

template <class Wanted, class OnEntry>
void SiteTree::visit(const Vec3& x, Wanted wanted, OnEntry on_entry) const {
  std::array<Visit, max_depth + 2> stack;
  std::size_t size = 0;
  stack[size++] = {NodeId(0), {0, 0, 0}};
  while (size > 0) {
    const Visit v = stack[--size];
    const Node& node = nodes_[v.node];
    if (!wanted(node, v.distance2())) continue;
    if (node.leaf()) {
      for (const Entry& e : leaves_[v.node]) on_entry(e);
      continue;
    }
    const double d = x[node.axis] - node.plane;
    Visit far = v;
    far.gap[static_cast<std::size_t>(node.axis)] = d;
    far.node = NodeId(node.child.value + (d < 0));
    stack[size++] = far;
    stack[size++] = {NodeId(node.child.value + (d >= 0)), v.gap};
  }
}

void SiteTree::rivals(SiteId p, std::vector<SiteId>& out) const {
  const WeightedPoint3& own = points_[p];
  visit(
      own.position,
      [&](const Node& node, double distance2) {
        const double rho2 = node.max_reach + own.weight;
        return rho2 >= 0 && within(distance2, root(rho2) + root(double{node.max_reach} + node.max_weight));
      },
      [&](const Entry& e) {
        const double rho2 = e.reach + own.weight;
        if (rho2 < 0 || e.site == p) return;
        if (within(distance2(own.position, e), root(rho2) + root(double{e.reach} + e.weight)))
          out.push_back(e.site);
      });
}

void SiteTree::heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const {
  visit(
      vacancy.center,
      [&](const Node& node, double distance2) {
        return within(distance2, vacancy.radius + root(vacancy.max_radius2 + node.max_weight));
      },
      [&](const Entry& e) {
        if (vacancy.max_radius2 + e.weight < 0) return;
        if (within(distance2(vacancy.center, e), vacancy.radius + root(vacancy.max_radius2 + e.weight)))
          out.push_back(e.site);
      });
}

/// What lies within slack of the best must be computed in doubles: (d - slack)^2 >= d^2 (1 - e) - slack^2 / e.
NeighbourSource::Nearest SiteTree::nearest(const Vec3& x, SiteId without, SiteId) const {
  constexpr double e = 0x1p-10;
  const double allowance = slack_ * slack_ / e;
  Nearest best{SiteId(), infinity};
  const auto hopeless = [&](double distance2, double weight) {
    return best.site.valid() && distance2 * (1 - e) - allowance - weight > best.radius2;
  };
  visit(
      x, [&](const Node& node, double distance2) { return !hopeless(distance2, node.max_weight); },
      [&](const Entry& entry) {
        if (entry.site == without || hopeless(distance2(x, entry), entry.weight)) return;
        const double radius2 = power(x, points_[entry.site]);
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
    ensure(distance2(points_[id].position, e) < slack_ * slack_ && points_[id].weight <= e.weight,
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
