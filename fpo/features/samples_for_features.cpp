#include "fpo/features/samples_for_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fpo/features/curve_clearance.h"
#include "fpo/features/curve_domain.h"
#include "fpo/features/curve_spacing.h"
#include "fpo/features/feature_choice.h"
#include "fpo/features/feature_samples.h"
#include "fpo/features/inner_share.h"

namespace fpo {
namespace {

namespace need {
constexpr double longest_edge = 1.25;  // in wanted lengths
constexpr double half_apart = 2 / longest_edge;
constexpr double strip_length = 1.5;  // in widths
constexpr double growth = 1.35;       // of lengths elsewhere, if strips are helped
constexpr double least_width = 0.15;  // in wanted lengths elsewhere, of strips that are helped
constexpr double rounding_share = 0.375;
constexpr double two_edges = 1.26, three_edges = 2.51, similar_edges = 0.63;
constexpr double share_of_samples = 4;
constexpr double rounding = 1e-9;
constexpr double step = 1.005;
constexpr double most_on_curves = 0.5;  // of all samples: else there are enough of them
constexpr double most_samples = 1e8;
constexpr std::size_t most_places = 100000;  // where curves are close: more would call for more samples
constexpr int bisections = 40;
}  // namespace need

/// Everything is said by how many times shorter lengths must be than those of n samples.
class Bound {
 public:
  explicit Bound(const FeatureBoundTask& task)
      : task_(task), spacing_(hexagonal_spacing(task.mesh.area(), task.n)) {}

  FeatureBound find() {
    for (const FeatureCurve& curve : task_.features.curves)
      lengths_.push_back(CurveMetric(task_.mesh, curve, task_.sizing).length());
    least_ = static_cast<double>(least_number_of_samples(task_.mesh, task_.features, task_.fixed));
    take(std::sqrt(least_ * (task_.yielding ? need::share_of_samples : 1) / static_cast<double>(task_.n)),
         FeatureNeed::number);
    take(for_short_curves(), FeatureNeed::short_curves);
    take(for_small_angles(), FeatureNeed::small_angles);
    if (samples() <= need::most_samples) take(for_close_curves(), FeatureNeed::close_curves);
    if (samples() <= need::most_samples) take(for_wanted_edges(), FeatureNeed::number);
    if (!(samples() <= need::most_samples)) return {0, need_};
    return {static_cast<std::size_t>(std::ceil((1 - need::rounding) * samples())), need_};
  }

 private:
  double samples() const { return static_cast<double>(task_.n) * shorter_ * shorter_; }
  void take(double shorter, FeatureNeed need) {
    if (shorter > shorter_) shorter_ = shorter, need_ = need;
  }

  /// The largest reach with which no curve collapses is one of those at which one begins to.
  double for_short_curves() const {
    std::vector<double> lengths;
    for (const FeatureCurve& curve : task_.features.curves) {
      const bool closes = curve.loop || curve.vertices.front() == curve.vertices.back();
      if (curve.sheets == 2) lengths.push_back(length_of(task_.mesh, curve) / (closes ? 3 : 1));
    }
    std::ranges::sort(lengths);
    const auto collapses = [&](double length) {
      return with_short_curves_collapsed(task_.mesh, task_.features, std::nextafter(length, 2 * length))
                 .curves.size() < task_.features.curves.size();
    };
    const auto first = std::ranges::partition_point(lengths, [&](double l) { return !collapses(l); });
    return first == lengths.end() ? 0 : shortest_curve * spacing_ / *first;
  }

  double for_small_angles() const {
    std::vector<double> edges(lengths_.size(), 1);
    const std::vector<CurveCorner> corners = curve_corners(task_.mesh, task_.features);
    for (const CurveCorner& corner : corners)
      if (is_acute(corner))
        for (const std::size_t c : {corner.curve, corner.other}) edges[c] += 1;
    double most = 0;
    for (const CurveCorner& corner : corners) {
      if (corner.angle >= std::numbers::pi / 2) continue;
      for (const std::size_t c : {corner.curve, corner.other})
        most = std::max(most, length_for(corner, edges[c]) / lengths_[c]);
    }
    return most;
  }

  static bool is_acute(const CurveCorner& corner) { return corner.angle < std::numbers::pi / 3; }

  /// Of a curve in wanted lengths, that has one edge more than small angles: then it has samples on the
  /// spheres about all of these.
  static double length_for(const CurveCorner& corner, double edges) {
    if (!is_acute(corner)) return std::min(need::similar_edges, need::longest_edge * std::cos(corner.angle));
    return std::max(edges > 2 ? need::three_edges : need::two_edges,
                    need::rounding_share / (1 - std::cos(corner.angle)));
  }

  double edges_on_curves(double shorter) const {
    double sum = least_;
    for (const double length : lengths_) sum += static_cast<double>(wanted_edges(length * shorter)) - 1;
    return sum;
  }

  /// Where curves have the edges that are wanted, and the surface between its samples, and these are not more
  /// than there are. Edges come one by one, so that somewhat longer curves may call for too many again; then
  /// a few are longer.
  double for_wanted_edges() const {
    if (need::most_on_curves * samples() >= edges_on_curves(shorter_)) return 0;
    const InnerShare inner(task_.mesh, task_.features, task_.sizing, 1 / shorter_);
    double shorter = shorter_;
    while (edges_on_curves(shorter) + inner.num_samples(need::growth * shorter_ / shorter) >
           static_cast<double>(task_.n) * shorter * shorter)
      shorter *= need::step;
    return shorter;
  }

  double for_close_curves() {
    double longest = 0;
    for (const FeatureCurve& curve : task_.features.curves)
      for (const geom::VertexId v : curve.vertices) longest = std::max(longest, task_.sizing.at(v));
    const double reach = need::growth / need::half_apart * longest / shorter_;
    places_ = curve_clearances(task_.mesh, task_.features, reach, need::most_places);
    if (places_.size() > need::most_places) return std::numeric_limits<double>::infinity();
    double everywhere = 0;
    for (const CurveClearance& place : places_) {
      wanted_.push_back(task_.sizing.at(place.at));
      everywhere = std::max(everywhere, wanted_.back() / (need::half_apart * place.distance));
    }
    if (!task_.sizing.is_uniform()) everywhere *= need::growth;
    double low = shorter_, high = everywhere;
    if (!(task_.gradation > 0) || !(low < high) || !strips_are_helped(high)) return everywhere;
    for (int step = 0; step < need::bisections; ++step) {
      const double middle = (low + high) / 2;
      (strips_are_helped(middle) ? high : low) = middle;
    }
    return high;
  }

  /// Are lengths lowered at all places that call for it, and do samples suffice?
  bool strips_are_helped(double shorter) const {
    const double s = spacing_ / shorter;
    double more = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const CurveClearance& place = places_[i];
      const double h = wanted_[i] / shorter, w = place.distance;
      const bool is_narrow = place.across && w < narrow_width * s;
      if (!is_narrow && need::growth * h > need::half_apart * w) return false;
      if (is_narrow && w < need::least_width * std::max(h, s)) return false;
      if (is_narrow) more += place.length * density_beside(w, std::max(h, s));
    }
    const double most =
        (1 - 1 / (need::growth * need::growth)) * static_cast<double>(task_.n) * shorter * shorter;
    return more <= most;
  }

  /// Samples for each length along a curve, on both sides.
  double density_beside(double w, double h) const {
    const double least = need::strip_length * w;
    const double beyond = h > least ? (1 / least - 1 / h) / task_.gradation : 0;
    return 2 / std::sqrt(3.0) * (w / 2 / (least * least) + beyond);
  }

  const FeatureBoundTask& task_;
  double spacing_;
  double shorter_ = 0;
  double least_ = 0;             // samples
  std::vector<double> lengths_;  // of the curves, in wanted lengths of n samples
  FeatureNeed need_ = FeatureNeed::number;
  std::vector<CurveClearance> places_;
  std::vector<double> wanted_;  // at each place, for n samples
};

}  // namespace

FeatureBound samples_for_features(const FeatureBoundTask& task) {
  if (task.features.curves.empty()) return {};
  return Bound(task).find();
}

}  // namespace fpo
