#include "fpo/features/feature_choice.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "fpo/features/feature_samples.h"
#include "fpo/features/fold_sides.h"
#include "fpo/features/weak_curves.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr double turn_scale = 0.5, fading = 2, long_as_closed = 20;  // in spacings

constexpr double cos_side_by_side = 0.9;  // 26 degrees

void reverse(FeatureCurve& curve) {
  std::ranges::reverse(curve.vertices);
  std::ranges::reverse(curve.facets);
}

/// Joins corners, curve by curve.
class Collapse {
 public:
  Collapse(const TriMesh& mesh, Features& features, double reach)
      : mesh_(mesh), features_(features), reach_(reach) {
    for (const FeatureCurve& curve : features.curves) lengths_.push_back(length_of(mesh, curve));
  }

  void run() {
    while (const std::optional<std::size_t> shortest = shortest_curve()) collapse(*shortest);
    for (std::size_t c = 0; c < features_.curves.size(); ++c)
      if (is_crease(c) && closes(c) && lengths_[c] < 3 * reach_) remove(c--);
    std::erase_if(features_.corners, [&](VertexId v) { return std::ranges::binary_search(lost_, v); });
  }

 private:
  bool is_crease(std::size_t c) const { return features_.curves[c].sheets == 2; }
  bool closes(std::size_t c) const {
    const FeatureCurve& curve = features_.curves[c];
    return curve.loop || curve.vertices.front() == curve.vertices.back();
  }

  std::optional<std::size_t> shortest_curve() const {
    std::optional<std::size_t> best;
    for (std::size_t c = 0; c < lengths_.size(); ++c)
      if (is_crease(c) && !closes(c) && lengths_[c] < reach_ && (!best || lengths_[c] < lengths_[*best]))
        best = c;
    return best;
  }

  std::size_t degree(VertexId v) const {
    std::size_t sum = 0;
    for (const FeatureCurve& curve : features_.curves)
      sum += !curve.loop * ((curve.vertices.front() == v) + (curve.vertices.back() == v));
    return sum;
  }
  /// Where a border ends cannot be moved.
  bool is_movable(VertexId v) const {
    return std::ranges::all_of(features_.curves, [v](const FeatureCurve& curve) {
      return curve.sheets == 2 || curve.loop || (curve.vertices.front() != v && curve.vertices.back() != v);
    });
  }

  /// From an end of a curve to its first vertex farther than `reach`, or its last one.
  geom::Vec3 direction(const FeatureCurve& curve, bool from_end) const {
    const std::size_t n = curve.vertices.size();
    const auto at = [&](std::size_t i) -> const geom::Vec3& {
      return mesh_.position(curve.vertices[from_end ? n - 1 - i : i]);
    };
    std::size_t i = 1;
    while (i + 1 < n && (at(i) - at(0)).norm() < reach_) ++i;
    return (at(i) - at(0)).normalized();
  }
  /// Of curves that are not short.
  std::vector<geom::Vec3> directions(VertexId v, std::size_t but) const {
    std::vector<geom::Vec3> result;
    for (std::size_t i = 0; i < features_.curves.size(); ++i)
      for (const bool end : {false, true}) {
        const FeatureCurve& curve = features_.curves[i];
        if (i != but && !curve.loop && lengths_[i] >= reach_ &&
            (end ? curve.vertices.back() : curve.vertices.front()) == v)
          result.push_back(direction(curve, end));
      }
    return result;
  }
  /// Do long curves run side by side from both its ends? The strip between them would end in nothing.
  bool ends_strip(std::size_t c) const {
    const FeatureCurve& curve = features_.curves[c];
    for (const geom::Vec3& u : directions(curve.vertices.front(), c))
      for (const geom::Vec3& v : directions(curve.vertices.back(), c))
        if (u.dot(v) > cos_side_by_side) return true;
    return false;
  }

  void remove(std::size_t c) {
    features_.curves.erase(features_.curves.begin() + static_cast<std::ptrdiff_t>(c));
    lengths_.erase(lengths_.begin() + static_cast<std::ptrdiff_t>(c));
  }

  /// The end where more curves meet stays; the others are led there along the curve.
  void collapse(std::size_t c) {
    FeatureCurve bridge = features_.curves[c];
    const VertexId first = bridge.vertices.front(), last = bridge.vertices.back();
    const double length = lengths_[c];
    if ((!is_movable(first) && !is_movable(last)) || ends_strip(c)) {
      lengths_[c] = reach_;  // it stays
      return;
    }
    const bool to_last = is_movable(first) && (!is_movable(last) || degree(last) > degree(first));
    if (!to_last) reverse(bridge);  // from the corner that goes to the one that stays
    remove(c);
    const VertexId gone = bridge.vertices.front();
    for (std::size_t i = 0; i < features_.curves.size(); ++i) {
      FeatureCurve& curve = features_.curves[i];
      for (int end = 0; end < 2 && !curve.loop; ++end) {
        reverse(curve);
        if (curve.vertices.back() != gone) continue;
        curve.vertices.insert(curve.vertices.end(), bridge.vertices.begin() + 1, bridge.vertices.end());
        curve.facets.insert(curve.facets.end(), bridge.facets.begin(), bridge.facets.end());
        lengths_[i] += length;
      }
    }
    lost_.insert(std::ranges::lower_bound(lost_, gone), gone);
  }

  const TriMesh& mesh_;
  Features& features_;
  double reach_;
  std::vector<double> lengths_;
  std::vector<VertexId> lost_;
};

/// Are most edges that are no creases within plane faces?
bool is_polyhedron(const TriMesh& mesh, const Features& features) {
  constexpr double cos_flat = 0.9998;  // a degree
  std::set<std::pair<VertexId, VertexId>> creases;
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t i = 0; i < curve.facets.size(); ++i)
      creases.insert(std::minmax(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()]));
  std::size_t others = 0, flat = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t e = 0; e < 3; ++e) {
      const FacetId u = mesh.across(t, static_cast<int>(e));
      const std::pair<VertexId, VertexId> ends = std::minmax(mesh.facet(t)[e], mesh.facet(t)[(e + 1) % 3]);
      if (!u.valid() || u < t || creases.contains(ends)) continue;
      ++others;
      const geom::Vec3 a = mesh.normal(t), b = mesh.normal(u);
      flat += a.dot(b) > cos_flat * a.norm() * b.norm();
    }
  return 2 * flat > others;
}

/// Folds everywhere, as in noise and on coarse models of animals: many curves of a few mesh edges, of which
/// more than three often meet. Edges of bodies with plane faces mostly meet by threes, and where they do not
/// there are diagonals in these faces; curves of fine meshes are long.
bool is_disorder(const TriMesh& mesh, const Features& features) {
  constexpr std::size_t many = 100, edges_of_long = 3;
  std::map<VertexId, std::size_t> degree;
  std::size_t creases = 0, edges = 0;
  for (const FeatureCurve& curve : features.curves) {
    if (curve.sheets != 2) continue;
    ++creases;
    edges += curve.facets.size();
    if (curve.loop) continue;
    ++degree[curve.vertices.front()];
    ++degree[curve.vertices.back()];
  }
  const auto crossings = std::ranges::count_if(degree, [](const auto& d) { return d.second > 3; });
  return creases > many &&
         edges<edges_of_long * creases&& static_cast<std::size_t>(crossings) * 4> degree.size() &&
         !is_polyhedron(mesh, features);
}

struct EdgeSum {
  std::size_t number = 0;
  double length = 0;
  double mean() const { return number > 0 ? length / static_cast<double>(number) : 0; }
};

/// Edges that were cut off in steps, as where a surface was taken from a lattice: many curves of a few edges,
/// no longer than others, in a fine mesh. Creases of a part consist of many edges there, or of long ones.
bool is_stepped(const TriMesh& mesh, const Features& features) {
  constexpr std::size_t many = 50, edges_of_long = 5, many_others = 20;
  constexpr double longer = 2;
  std::set<std::pair<VertexId, VertexId>> creases;
  std::size_t curves = 0;
  for (const FeatureCurve& curve : features.curves) {
    curves += curve.sheets == 2;
    for (std::size_t i = 0; i < curve.facets.size() && curve.sheets == 2; ++i)
      creases.insert(std::minmax(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()]));
  }
  if (curves <= many || creases.size() >= edges_of_long * curves) return false;
  EdgeSum sharp, others;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t e = 0; e < 3; ++e) {
      const FacetId u = mesh.across(t, static_cast<int>(e));
      if (!u.valid() || u < t) continue;
      const std::pair<VertexId, VertexId> ends = std::minmax(mesh.facet(t)[e], mesh.facet(t)[(e + 1) % 3]);
      EdgeSum& sum = creases.contains(ends) ? sharp : others;
      ++sum.number;
      sum.length += (mesh.position(ends.second) - mesh.position(ends.first)).norm();
    }
  return others.number > many_others * sharp.number && sharp.mean() < longer * others.mean();
}

/// Curves along edges that somebody asked for are not given up.
class AskedFor {
 public:
  explicit AskedFor(const FeatureOptions& options) {
    for (const auto& [a, b] : options.marked) edges_.insert(std::minmax(a, b));
  }
  bool has(const FeatureCurve& curve) const {
    for (std::size_t i = 0; i < curve.facets.size() && !edges_.empty(); ++i)
      if (edges_.contains(std::minmax(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()])))
        return true;
    return false;
  }

 private:
  std::set<std::pair<VertexId, VertexId>> edges_;
};

struct StrongCurves {
  FeatureOptions options;  ///< that find them
  Features features;
  std::size_t given_up = 0;
};

/// Without the weakest creases, until the features need no more than a third of the samples, and of creases
/// with hardly a triangle between them one is left. None if that takes half of what there is to be seen, or
/// if curves are so many that they are hardly those of a part.
std::optional<StrongCurves> strong_curves(const TriMesh& mesh, const FeatureOptions& options,
                                          const Features& all, const SamplingPlan& plan) {
  constexpr double least_left = 0.5;
  constexpr std::size_t most_curves = 500, share_of_samples = 3;
  if (all.curves.size() > most_curves) return {};
  const auto fits = [&](const Features& f) {
    const Features left = with_short_curves_collapsed(mesh, f, shortest_curve * plan.spacing);
    return share_of_samples * least_number_of_samples(mesh, left, plan.fixed) <= plan.num_samples;
  };
  StrongCurves result{options, all};
  const AskedFor asked_for(options);
  const auto seen_now = [&] {
    SeenCurves seen = seen_curves(mesh, result.features, plan.spacing);
    for (std::size_t c = 0; c < seen.strengths.size(); ++c)
      if (asked_for.has(result.features.curves[c]))
        seen.strengths[c] = std::numeric_limits<double>::infinity();
    return seen;
  };
  SeenCurves seen = seen_now();
  const double enough = least_left * total_strength(seen);
  while (true) {
    WeakCurves wanted{.only_crowded = true};
    std::vector<std::size_t> weak = weakest_curves(seen, wanted);
    if (weak.empty() && fits(result.features)) return result;
    wanted.only_crowded = false;
    if (weak.empty()) weak = weakest_curves(seen, wanted);
    if (weak.empty()) return {};
    for (const auto& edge : edges_of_curves(result.features, weak)) result.options.unmarked.push_back(edge);
    result.features = find_features(mesh, result.options);
    result.given_up += weak.size();
    seen = seen_now();
    if (total_strength(seen) < enough) return {};
  }
}

}  // namespace

bool has_creases(const Features& features) {
  return std::ranges::any_of(features.curves, [](const FeatureCurve& c) { return c.sheets == 2; });
}

Features with_short_curves_collapsed(const TriMesh& mesh, Features features, double reach) {
  Collapse(mesh, features, reach).run();
  return features;
}

namespace {

/// What fades out is judged by the spacing.
void judge_fading(FeatureOptions& options, double spacing) {
  if (!options.yielding) return;
  options.long_as_closed = long_as_closed * spacing;
  options.shortest_fading = fading * spacing;
}

}  // namespace

Features all_features(const TriMesh& mesh, FeatureOptions options, double spacing) {
  judge_fading(options, spacing);
  Features features = find_features(mesh, options);
  const auto is_in_vain = [&] {
    return is_noise(fold_sides(mesh, features)) || is_disorder(mesh, features) || is_stepped(mesh, features);
  };
  return options.yielding && is_in_vain() ? Features{} : features;
}

FeatureChoice choose_features(const TriMesh& mesh, FeatureOptions options, const SamplingPlan& plan) {
  options.turn_scale = turn_scale * plan.spacing;
  judge_fading(options, plan.spacing);
  FeatureChoice result{find_features(mesh, options), {}};
  const auto needed = [&] { return least_number_of_samples(mesh, result.features, plan.fixed); };
  // Collapsing takes its time where there are thousands of short curves: noise goes first.
  const bool noise = options.yielding && is_noise(fold_sides(mesh, result.features));
  const bool disorder = options.yielding && is_disorder(mesh, result.features);
  const bool stepped = options.yielding && is_stepped(mesh, result.features);
  const bool too_many = options.yielding && has_creases(result.features) && 2 * needed() > plan.num_samples;
  std::optional<StrongCurves> strong;
  if ((too_many || (plan.strong_only && options.yielding)) && !noise && !disorder && !stepped)
    strong = strong_curves(mesh, options, result.features, plan);
  if (strong) {
    result.are_missed = strong->given_up > 0;
    if (strong->given_up > 0)
      result.given_up = "creases given up: " + std::to_string(strong->given_up) + " of " +
                        std::to_string(result.features.curves.size()) +
                        " curves, the flattest, shortest and closest to others: samples are too few for all";
    options = strong->options;
    result.features = strong->features;
  } else if (noise || disorder || stepped || too_many) {
    const std::size_t curves = result.features.curves.size(), least = needed();
    options.crease_angle = options.weak_crease_angle = 180;
    options.apex_angle = 0;
    result.features = find_features(mesh, options);
    result.are_missed = !noise && !stepped;
    result.given_up = "creases dropped: " + std::to_string(curves) + " curves ";
    result.given_up += noise      ? "are folded to both sides by turns, as in noise"
                       : disorder ? "cross each other everywhere"
                       : stepped  ? "are edges cut off in steps"
                                  : "would take at least " + std::to_string(least) + " of " +
                                       std::to_string(plan.num_samples) + " samples";
    if (least <= plan.num_samples) result.given_up += "; --features 45 keeps them";
  }
  if (options.yielding && needed() > plan.num_samples) {
    options.corner_turn = 180;
    result.features = find_features(mesh, options);
    result.are_missed = true;
    result.given_up = "corners of borders dropped: there are too few samples";
  }
  const std::size_t curves = result.features.curves.size();
  result.features =
      with_short_curves_collapsed(mesh, std::move(result.features), shortest_curve * plan.spacing);
  result.collapsed = curves - result.features.curves.size();
  return result;
}

}  // namespace fpo
