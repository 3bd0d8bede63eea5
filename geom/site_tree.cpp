#include "geom/site_tree.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t leaf_capacity = 12;
constexpr int max_depth = 96;  // bounds the stack of a visit: two entries a level

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
double root(double x) { return x > 0 ? std::sqrt(x) : 0; }

/// |p - q|^2 < reach^2 with room for rounding: the distances were computed from coordinates within a few ulps
/// of each other or of a corner whose error is of that order.
bool within(double distance2, double reach) { return distance2 <= reach * reach * (1 + 1e-9) + 1e-300; }

}  // namespace

SiteTree::SiteTree() {
  nodes_.push_back({});
  nodes_[0].child = 0;
  leaves_.emplace_back();
}

const SiteTree::Entry& SiteTree::entry(SiteId id) const {
  const Place place = places_[id];
  return leaf(place.node)[at(place.slot)];
}

void SiteTree::insert(SiteId id, const WeightedPoint3& point, SiteId) {
  std::int32_t node = 0;
  int depth = 0;
  while (!nodes_[at(node)].leaf()) {
    const Node& inner = nodes_[at(node)];
    node = inner.child + (point.position[inner.axis] >= inner.plane);
    ++depth;
  }
  if (id.index() >= places_.size()) places_.resize(id.index() + 1);
  ensure(places_[id].node < 0, "site tree: the site is already in");
  std::vector<Entry>& entries = leaf(node);
  places_[id] = {node, static_cast<std::int32_t>(entries.size())};
  entries.push_back({point.position, point.weight, -infinity, id});
  if (entries.size() > leaf_capacity && depth < max_depth) split(node);
  refresh(places_[id].node);
}

void SiteTree::remove(SiteId id) {
  const Place place = places_[id];
  std::vector<Entry>& entries = leaf(place.node);
  entries[at(place.slot)] = entries.back();
  places_[entries.back().site].slot = place.slot;
  entries.pop_back();
  places_[id] = {};
  refresh(place.node);
}

void SiteTree::set_reach(SiteId j, double max_radius2) {
  const Place place = places_[j];
  double& reach = leaf(place.node)[at(place.slot)].reach;
  const double before = reach;
  reach = max_radius2;
  if (max_radius2 >= before)
    for (std::int32_t i = place.node; i >= 0 && nodes_[at(i)].max_reach < max_radius2;
         i = nodes_[at(i)].parent)
      nodes_[at(i)].max_reach = max_radius2;
  else if (before == nodes_[at(place.node)].max_reach)
    refresh(place.node);
}

/// Halves a leaf at the median of its longest side. Sites at one position cannot be told apart and stay
/// together.
void SiteTree::split(std::int32_t node) {
  Box3 box;
  for (const Entry& e : leaf(node)) box.extend(e.position);
  int axis = 0;
  if (!(box.sizes().maxCoeff(&axis) > 0)) return;
  std::vector<double> coordinates;
  for (const Entry& e : leaf(node)) coordinates.push_back(e.position[axis]);
  std::sort(coordinates.begin(), coordinates.end());
  // The lower half must not be empty: a plane above the smallest coordinate, at the median if that is
  // possible.
  double plane = coordinates[coordinates.size() / 2];
  if (plane == coordinates.front()) plane = *std::upper_bound(coordinates.begin(), coordinates.end(), plane);

  const auto lower = static_cast<std::int32_t>(nodes_.size());
  const std::vector<Entry> entries = std::move(leaf(node));
  leaf(node).clear();
  nodes_.resize(nodes_.size() + 2);
  nodes_[at(lower)].child = nodes_[at(node)].child;  // the lower child inherits the leaf
  nodes_[at(lower) + 1].child = static_cast<std::int32_t>(leaves_.size());
  leaves_.emplace_back();
  nodes_[at(lower)].parent = nodes_[at(lower) + 1].parent = node;
  nodes_[at(node)].axis = axis;
  nodes_[at(node)].plane = plane;
  nodes_[at(node)].child = lower;
  for (const Entry& e : entries) {
    const std::int32_t child = lower + (e.position[axis] >= plane);
    places_[e.site] = {child, static_cast<std::int32_t>(leaf(child).size())};
    leaf(child).push_back(e);
  }
  refresh(lower);
  refresh(lower + 1);
}

/// Recomputes the bounds of a node from below and carries them up as far as they change.
void SiteTree::refresh(std::int32_t node) {
  for (; node >= 0; node = nodes_[at(node)].parent) {
    Node& n = nodes_[at(node)];
    double reach = -infinity, weight = -infinity;
    if (n.leaf()) {
      for (const Entry& e : leaf(node)) reach = std::max(reach, e.reach), weight = std::max(weight, e.weight);
    } else {
      const Node &low = nodes_[at(n.child)], &high = nodes_[at(n.child) + 1];
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
  stack[size++] = {0, {0, 0, 0}};
  while (size > 0) {
    const Visit v = stack[--size];
    const Node& node = nodes_[at(v.node)];
    if (!wanted(node, v.distance2())) continue;
    if (node.leaf()) {
      for (const Entry& e : leaf(v.node)) on_entry(e);
      continue;
    }
    const double d = x[node.axis] - node.plane;
    Visit far = v;
    far.gap[at(node.axis)] = d;
    far.node = node.child + (d < 0);
    stack[size++] = far;
    stack[size++] = {node.child + (d >= 0), v.gap};
  }
}

void SiteTree::rivals(SiteId p, std::vector<SiteId>& out) const {
  const Entry& own = entry(p);
  visit(
      own.position,
      [&](const Node& node, double distance2) {
        const double rho2 = node.max_reach + own.weight;
        return rho2 >= 0 && within(distance2, root(rho2) + root(node.max_reach + node.max_weight));
      },
      [&](const Entry& e) {
        const double rho2 = e.reach + own.weight;
        if (rho2 < 0 || e.site == p) return;
        const double distance2 = (e.position - own.position).squaredNorm();
        if (within(distance2, root(rho2) + root(e.reach + e.weight))) out.push_back(e.site);
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
        const double distance2 = (e.position - vacancy.center).squaredNorm();
        if (within(distance2, vacancy.radius + root(vacancy.max_radius2 + e.weight))) out.push_back(e.site);
      });
}

NeighbourSource::Nearest SiteTree::nearest(const Vec3& x, SiteId without, SiteId) const {
  Nearest best{SiteId(), infinity};
  visit(
      x,
      [&](const Node& node, double distance2) {
        return distance2 * (1 - 1e-12) - node.max_weight <= best.radius2;
      },
      [&](const Entry& e) {
        const double radius2 = power(x, {e.position, e.weight});
        const bool better = radius2 < best.radius2 || (radius2 == best.radius2 && e.site < best.site);
        if (e.site != without && (better || !best.site.valid())) best = {e.site, radius2};
      });
  return best;
}

void SiteTree::check() const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const SiteId id(i);
    const Place place = places_[id];
    if (place.node < 0) continue;
    const Entry& e = entry(id);
    ensure(e.site == id, "site tree: a place names another site");
    for (std::int32_t child = place.node, node = nodes_[at(child)].parent; node >= 0;
         child = node, node = nodes_[at(node)].parent) {
      const Node& n = nodes_[at(node)];
      ensure(child == n.child + (e.position[n.axis] >= n.plane),
             "site tree: a site is on the wrong side of a plane");
    }
    for (std::int32_t node = place.node; node >= 0; node = nodes_[at(node)].parent)
      ensure(e.reach <= nodes_[at(node)].max_reach && e.weight <= nodes_[at(node)].max_weight,
             "site tree: a node's bound is below a site's");
  }
}

}  // namespace geom
