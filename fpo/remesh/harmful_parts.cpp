#include "fpo/remesh/harmful_parts.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "fpo/features/feature_choice.h"
#include "fpo/features/weak_curves.h"

namespace fpo {

using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr double spacings_worth = 10;  // of a crease folded by 90 degrees: one angle of nothing
constexpr double least_left = 0.5;     // of all that there is to be seen
constexpr double least_kept = 2;       // in spacings: what fades out and is shorter is not kept

/// Some edges of a curve.
struct Part {
  std::size_t curve;
  std::vector<bool> edges;  ///< of the curve: is it one of them?
  double lacking = 0;       ///< in the angles that they are to blame for
};

bool overlap(const Part& a, const Part& b) {
  if (a.curve != b.curve) return false;
  for (std::size_t i = 0; i < a.edges.size(); ++i)
    if (a.edges[i] && b.edges[i]) return true;
  return false;
}

/// The parts that are to blame for angles.
class Blame {
 public:
  Blame(const TriMesh& surface, const Features& features, const SeenCurves& seen,
        std::span<const FeatureEdge> spared)
      : surface_(surface), features_(features), seen_(seen), of_edges_(features.curves.size()) {
    for (const auto& [a, b] : spared) spared_.insert(std::minmax(a, b));
  }

  /// To that of which there is the least to be seen, but for what is to blame for others already.
  void put(const SmallAngle& angle);

  const std::vector<Part>& parts() const { return parts_; }
  /// What there is to be seen of it.
  double strength(const Part& part);
  CreasePart crease(const Part& part) const;

 private:
  bool may_go(std::size_t c) const {
    return features_.curves[c].sheets == 2 && seen_.lengths[c] >= shortest_curve * seen_.spacing;
  }
  double length(const Part& part) const;
  bool is_spared(const Part& part) const;
  Part near_part(std::size_t c, const SmallAngle& angle) const;
  double strength_added(const Part& part);
  void absorb(Part part);

  const TriMesh& surface_;
  const Features& features_;
  const SeenCurves& seen_;
  std::set<std::pair<VertexId, VertexId>> spared_;
  std::vector<std::vector<double>> of_edges_;  ///< what there is to be seen of them, of each curve
  std::vector<Part> parts_;                    ///< that do not overlap
};

double Blame::strength(const Part& part) {
  std::vector<double>& of_edges = of_edges_[part.curve];
  if (of_edges.empty()) of_edges = seen_of_edges(surface_, features_.curves[part.curve]);
  double share = 0;
  for (std::size_t i = 0; i < part.edges.size(); ++i)
    if (part.edges[i]) share += of_edges[i];
  return share * seen_.strengths[part.curve];
}

CreasePart Blame::crease(const Part& part) const {
  CreasePart result{part.curve, {}, std::ranges::count(part.edges, false) == 0, part.lacking};
  for (std::size_t i = 0; i < part.edges.size(); ++i)
    if (part.edges[i]) result.edges.push_back(edge_of(features_.curves[part.curve], i));
  return result;
}

double Blame::length(const Part& part) const {
  double sum = 0;
  for (std::size_t i = 0; i < part.edges.size(); ++i) {
    const auto [a, b] = edge_of(features_.curves[part.curve], i);
    if (part.edges[i]) sum += (surface_.position(b) - surface_.position(a)).norm();
  }
  return sum;
}

bool Blame::is_spared(const Part& part) const {
  for (std::size_t i = 0; i < part.edges.size(); ++i) {
    const auto [a, b] = edge_of(features_.curves[part.curve], i);
    if (part.edges[i] && spared_.contains(std::minmax(a, b))) return true;
  }
  return false;
}

/// All if hardly anything is left.
Part Blame::near_part(std::size_t c, const SmallAngle& angle) const {
  const Part part{c, NearEdges(surface_, features_, angle, seen_.spacing).of(c)};
  if (seen_.lengths[c] - length(part) >= least_kept * seen_.spacing) return part;
  return {c, std::vector<bool>(part.edges.size(), true)};
}

double Blame::strength_added(const Part& part) {
  Part added = part;
  for (const Part& old : parts_)
    for (std::size_t i = 0; old.curve == part.curve && i < added.edges.size(); ++i)
      if (old.edges[i]) added.edges[i] = false;
  return strength(added);
}

/// Those absorbed overlap no other, so what it becomes overlaps none that is left.
void Blame::absorb(Part part) {
  std::erase_if(parts_, [&](const Part& old) {
    if (!overlap(old, part)) return false;
    part.lacking += old.lacking;
    for (std::size_t i = 0; i < old.edges.size(); ++i)
      if (old.edges[i]) part.edges[i] = true;
    return true;
  });
  parts_.push_back(std::move(part));
}

void Blame::put(const SmallAngle& angle) {
  std::optional<Part> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t c : angle.to_blame) {
    if (!may_go(c)) continue;
    Part part = near_part(c, angle);
    const double added = is_spared(part) ? std::numeric_limits<double>::infinity() : strength_added(part);
    if (!(added < least)) continue;
    least = added;
    best = std::move(part);
  }
  if (!best) return;
  best->lacking = angle.lacking;
  absorb(std::move(*best));
}

}  // namespace

double worth_of_angles(double lacking) { return spacings_worth * lacking; }

std::vector<CreasePart> harmful_parts(const TriMesh& surface, const Features& features,
                                      const RemeshWithCurves& remesh, const HarmOptions& options) {
  const std::vector<SmallAngle> angles = angles_at_curves(surface, features, remesh, options.spacing);
  if (angles.empty()) return {};
  const SeenCurves seen = seen_curves(surface, features, options.spacing);
  Blame blame(surface, features, seen, options.spared);
  for (const SmallAngle& angle : angles) blame.put(angle);
  std::vector<std::pair<double, const Part*>> harmful;  // with their strengths
  for (const Part& part : blame.parts()) {
    const double strength = blame.strength(part);
    if (worth_of_angles(part.lacking) >= strength) harmful.emplace_back(strength, &part);
  }
  std::ranges::stable_sort(harmful, {}, [](const auto& part) { return part.first / part.second->lacking; });
  const double most = (1 - least_left) * total_strength(seen);
  double lost = 0;
  std::vector<CreasePart> result;
  for (const auto& [strength, part] : harmful) {
    if (lost + strength > most) continue;
    lost += strength;
    result.push_back(blame.crease(*part));
    result.back().strength = strength;
  }
  return result;
}

}  // namespace fpo
