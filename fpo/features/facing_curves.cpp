#include "fpo/features/facing_curves.h"

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>

namespace fpo {

using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr double nearly_all = 0.8;  // of the length of a curve but for two widths at its ends
constexpr double opposite = 1.6;    // widths between ends that are

bool ends_are_opposite(const TriMesh& mesh, const FeatureCurve& a, const FeatureCurve& b, double width) {
  if (a.loop || b.loop) return a.loop && b.loop;
  const VertexId a0 = a.vertices.front(), a1 = a.vertices.back(), b0 = b.vertices.front(),
                 b1 = b.vertices.back();
  const auto are_near = [&](VertexId v, VertexId w) {
    return v != w && (mesh.position(v) - mesh.position(w)).norm() <= opposite * width;
  };
  return (are_near(a0, b0) && are_near(a1, b1)) || (are_near(a0, b1) && are_near(a1, b0));
}

/// How one curve faces another.
struct FacedCurve {
  double length = 0;  ///< of the first, as far as it does
  std::vector<double> widths;
};

/// Two curves that face each other all along.
struct Candidate {
  double width;
  std::size_t a, b;
};

std::vector<Candidate> candidates(const TriMesh& mesh, const Features& features,
                                  std::span<const NarrowPlace> places) {
  std::map<std::pair<std::size_t, std::size_t>, FacedCurve> facing;
  for (const NarrowPlace& place : places) {
    FacedCurve& f = facing[{place.curve, place.other}];
    f.length += place.length;
    f.widths.push_back(place.width);
  }
  const auto is_all_along = [&](std::size_t c, const FacedCurve& f, double width) {
    const FeatureCurve& curve = features.curves[c];
    return f.length >= nearly_all * (length_of(mesh, curve) - (curve.loop ? 0 : 2 * width));
  };
  std::vector<Candidate> result;
  for (auto& [curves, f] : facing) {
    const auto [a, b] = curves;
    const auto back = facing.find({b, a});
    if (a >= b || back == facing.end()) continue;
    const auto middle = f.widths.begin() + std::ssize(f.widths) / 2;
    std::nth_element(f.widths.begin(), middle, f.widths.end());
    if (is_all_along(a, f, *middle) && is_all_along(b, back->second, *middle) &&
        ends_are_opposite(mesh, features.curves[a], features.curves[b], *middle))
      result.push_back({*middle, a, b});
  }
  std::ranges::sort(result, {}, [](const Candidate& c) { return std::tuple(c.width, c.a, c.b); });
  return result;
}

/// Curves in groups within which each is in step with the first one or opposite to it.
class Groups {
 public:
  explicit Groups(std::size_t num_curves) {
    for (std::size_t c = 0; c < num_curves; ++c) group_.push_back(c), members_.push_back({c});
    opposite_.assign(num_curves, false);
  }

  /// False if they are in step already.
  bool set_opposite(std::size_t a, std::size_t b) {
    if (group_[a] == group_[b]) return opposite_[a] != opposite_[b];
    if (members_[group_[a]].size() < members_[group_[b]].size()) std::swap(a, b);
    const std::size_t into = group_[a], from = group_[b];
    if (opposite_[a] == opposite_[b]) turn(from);
    for (const std::size_t c : members_[from]) group_[c] = into, members_[into].push_back(c);
    members_[from].clear();
    return true;
  }

  void turn(std::size_t group) {
    for (const std::size_t c : members_[group]) opposite_[c] = !opposite_[c];
  }
  std::size_t group(std::size_t curve) const { return group_[curve]; }
  const std::vector<std::size_t>& members(std::size_t group) const { return members_[group]; }
  bool is_opposite(std::size_t curve) const { return opposite_[curve]; }

 private:
  std::vector<std::size_t> group_;
  std::vector<std::vector<std::size_t>> members_;
  std::vector<bool> opposite_;
};

/// Turns groups so that curves that meet are in step, from each group to those that it meets.
void agree_at_corners(const Features& features, Groups& groups) {
  std::map<VertexId, std::vector<std::size_t>> at_corner;
  const auto is_alone = [&](std::size_t c) { return groups.members(groups.group(c)).size() < 2; };
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    if (curve.loop || is_alone(c)) continue;
    at_corner[curve.vertices.front()].push_back(c), at_corner[curve.vertices.back()].push_back(c);
  }
  const auto for_each_meeting = [&](std::size_t group, auto visit) {
    for (const std::size_t c : groups.members(group)) {
      const FeatureCurve& curve = features.curves[c];
      if (curve.loop) continue;
      for (const VertexId v : {curve.vertices.front(), curve.vertices.back()})
        for (const std::size_t d : at_corner.at(v))
          if (groups.group(d) != group) visit(c, d);
    }
  };
  std::vector<bool> seen(features.curves.size(), false), chosen = seen;  // groups
  for (std::size_t first = 0; first < features.curves.size(); ++first) {
    if (is_alone(first) || seen[groups.group(first)]) continue;
    std::deque<std::size_t> next{groups.group(first)};
    seen[next.front()] = true;
    for (; !next.empty(); next.pop_front()) {
      int agreement = 0;
      for_each_meeting(next.front(), [&](std::size_t c, std::size_t d) {
        const std::size_t other = groups.group(d);
        if (chosen[other]) agreement += groups.is_opposite(c) == groups.is_opposite(d) ? 1 : -1;
        if (!seen[other]) next.push_back(other), seen[other] = true;
      });
      if (agreement < 0) groups.turn(next.front());
      chosen[next.front()] = true;
    }
  }
}

}  // namespace

std::vector<FacingPair> facing_pairs(const TriMesh& mesh, const Features& features,
                                     std::span<const NarrowPlace> places) {
  std::vector<Candidate> found = candidates(mesh, features, places);
  Groups groups(features.curves.size());
  std::erase_if(found, [&](const Candidate& c) { return !groups.set_opposite(c.a, c.b); });
  agree_at_corners(features, groups);
  std::vector<FacingPair> pairs;
  for (const auto& [width, a, b] : found) {
    const bool b_leads = groups.is_opposite(a);
    const std::size_t leading = b_leads ? b : a;
    pairs.push_back({leading, b_leads ? a : b, width, length_of(mesh, features.curves[leading])});
  }
  return pairs;
}

}  // namespace fpo
