#include "fpo/features/feature_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "fpo/features/curve_domain.h"
#include "fpo/features/even_places.h"
#include "fpo/features/facing_curves.h"
#include "fpo/features/facing_samples.h"
#include "fpo/features/inner_share.h"
#include "geom/check.h"
#include "geom/mesh/angles.h"
#include "geom/mesh/edges.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double longest_edge = 1.25;
constexpr double too_narrow = 0.29;   // width over edge length: below it even these have angles under 30
constexpr double wide_enough = 0.62;  // width over edge length: right triangles have 32 degrees
constexpr double least_share = 0.3, share_step = 0.025;  // of samples that are placed before others face them

/// The part of a curve between two samples that stay, or a loop without any.
struct Stretch {
  std::size_t curve;
  double start, length;  ///< in the curve's metric
  SiteId from, to;       ///< none: a loop
  std::size_t least_edges = 1;
  /// At each end: how much longer than the others its gap shall be, at a corner with a small angle.
  std::array<double, 2> stretch_at_end{0, 0};  ///< 0: no such corner, as all others
};

/// Two curves leave a corner at an angle a; both have samples at distance 1 and 1 + e from it. The triangle
/// of the nearer samples and a farther one has, there, the angle b with tan b = sin a / (e + 1 - cos a). The
/// distance, in units of e, at which b is the least of a and 30 degrees; never below 1.
double first_gap(double angle) {
  const double wanted = std::tan(std::min(angle, std::numbers::pi / 6));
  const double e = wanted > 0 ? std::sin(angle) / wanted - (1 - std::cos(angle)) : 1;
  return std::clamp(1 / e, 1.0, 1.4);
}

/// Stretches whose samples are opposite to the middles of another one's edges, by that one.
struct Staggered {
  std::size_t leading, staggered;  ///< stretches
  double width_share;              ///< width over the length of the leading one
};

/// Features as samples that are given and stretches between them.
class Layout {
 public:
  Layout(const TriMesh& mesh, const Features& features, std::span<const SurfaceSample> fixed,
         const Sizing& sizing)
      : mesh_(mesh), features_(features), shares_(mesh.num_vertices(), 0.0), facet_(mesh.num_vertices()) {
    for (const FeatureCurve& curve : features.curves) metrics_.emplace_back(mesh, curve, sizing);
    measure_vertices();
    for (const SurfaceSample& x : fixed) add(x, 1);
    num_fixed_ = samples_.size();
    for (const VertexId v : features.corners) corner_[v] = add({mesh.position(v), facet_[v]}, shares_[v]);
    for (std::size_t c = 0; c < features.curves.size(); ++c) divide(c);
    require_simplicial();
    find_acute_corners();
  }

  const std::vector<SurfaceSample>& samples() const { return samples_; }
  const std::vector<Stretch>& stretches() const { return stretches_; }
  const CurveMetric& metric(std::size_t curve) const { return metrics_[curve]; }
  std::span<const CurveMetric> metrics() const { return metrics_; }
  double missing_shares() const { return missing_shares_; }

  /// Edges of each stretch if lengths are divided by `stretching`; of a staggered one as many as the leading
  /// one has, half of them at each end of those that are no loops.
  std::vector<std::size_t> edges(double stretching) const {
    std::vector<std::size_t> result;
    for (const Stretch& s : stretches_)
      result.push_back(std::max(s.least_edges, wanted_edges(s.length / stretching)));
    for (const Staggered& pair : staggered_)
      if (is_staggered(pair, result))
        result[pair.staggered] = result[pair.leading] + (stretches_[pair.leading].from.valid() ? 1 : 0);
    return result;
  }

  /// For pairs of curves that nothing divides.
  void stagger(std::span<const FacingPair> pairs) {
    staggered_.clear();
    for (const FacingPair& pair : pairs) {
      const auto a = only_stretch(pair.leading), b = only_stretch(pair.staggered);
      const auto is_b = [&](const Staggered& s) { return s.staggered == *b; };
      if (a && b && std::ranges::none_of(staggered_, is_b))
        staggered_.push_back({*a, *b, pair.width / pair.length});
    }
  }
  const std::vector<Staggered>& staggered() const { return staggered_; }
  /// Whether edges are so long in comparison with the width that it matters, and not too long.
  bool is_staggered(const Staggered& pair, std::span<const std::size_t> edges) const {
    const double width = pair.width_share * static_cast<double>(edges[pair.leading]);
    return width >= too_narrow && width < wide_enough;
  }
  /// The least number of samples.
  std::size_t least() const { return num_samples(edges(std::numeric_limits<double>::infinity())); }
  std::size_t num_samples(const std::vector<std::size_t>& edges) const {
    std::size_t sum = samples_.size();
    for (std::size_t i = 0; i < edges.size(); ++i) sum += edges[i] - (stretches_[i].from.valid() ? 1 : 0);
    return sum;
  }

 private:
  std::optional<std::size_t> only_stretch(std::size_t curve) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      if (stretches_[i].curve != curve) continue;
      if (found) return {};
      found = i;
    }
    return found;
  }

  void measure_vertices() {
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
      for (int i = 0; i < 3; ++i) {
        const VertexId v = mesh_.facet(t)[static_cast<std::size_t>(i)];
        shares_[v] += geom::corner_angle(mesh_, t, i) / (2 * std::numbers::pi);
        if (!facet_[v].valid()) facet_[v] = t;
      }
  }

  /// A sample at a place that has one already is that one.
  SiteId add(const SurfaceSample& x, double share) {
    const auto [at, is_new] =
        at_.try_emplace({x.position.x(), x.position.y(), x.position.z()}, SiteId(samples_.size()));
    if (is_new) {
      samples_.push_back(x);
      missing_shares_ += 1 - share;
    }
    return at->second;
  }

  void divide(std::size_t c) {
    const FeatureCurve& curve = features_.curves[c];
    const double length = metrics_[c].length();
    std::vector<std::pair<double, SiteId>> stops;
    if (!curve.loop)
      stops = {{0, corner_.at(curve.vertices.front())}, {length, corner_.at(curve.vertices.back())}};
    const double near = point_tolerance * mesh_.diagonal();
    for (std::size_t i = 0; i < num_fixed_; ++i) {
      const CurveMetric::Nearest nearest = metrics_[c].nearest(samples_[i].position);
      if (nearest.distance2 > near * near || is_stop(stops, SiteId(i))) continue;
      stops.emplace_back(nearest.t, SiteId(i));
      missing_shares_ += 1 - static_cast<double>(curve.sheets) / 2;
    }
    std::ranges::sort(stops);
    if (stops.empty()) stretches_.push_back({c, 0, length, SiteId(), SiteId()});
    for (std::size_t i = 0; i + 1 < stops.size(); ++i)
      stretches_.push_back(
          {c, stops[i].first, stops[i + 1].first - stops[i].first, stops[i].second, stops[i + 1].second});
    if (curve.loop && !stops.empty())
      stretches_.push_back({c, stops.back().first, length - stops.back().first + stops.front().first,
                            stops.back().second, stops.front().second});
  }

  static bool is_stop(const std::vector<std::pair<double, SiteId>>& stops, SiteId x) {
    return std::ranges::any_of(stops, [&](const auto& stop) { return stop.second == x; });
  }

  void require_simplicial() {
    std::map<std::pair<SiteId, SiteId>, Stretch*> shortest;  // of those that join the same two samples
    for (Stretch& s : stretches_) {
      if (!s.from.valid() || s.from == s.to) {
        s.least_edges = 3;
        continue;
      }
      const auto [at, is_first] = shortest.try_emplace(std::minmax(s.from, s.to), &s);
      if (is_first) continue;
      Stretch& longer = s.length < at->second->length ? *std::exchange(at->second, &s) : s;
      longer.least_edges = 2;
    }
  }

  /// Marks the ends of stretches that leave a corner at less than 60 degrees to another one.
  void find_acute_corners() {
    struct Leaving {
      std::size_t stretch, end;
      Vec3 direction;
    };
    std::map<SiteId, std::vector<Leaving>> at_corner;
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      const Stretch& s = stretches_[i];
      if (!s.from.valid()) continue;
      const CurveMetric& metric = metrics_[s.curve];
      const double reach = std::min(1.0, s.length / 2);
      const auto leave = [&](SiteId corner, std::size_t end, double t) {
        if (t >= metric.length()) t -= metric.length();
        if (corner.index() >= num_fixed_)
          at_corner[corner].push_back({i, end, metric.at(t).position - samples_[corner.index()].position});
      };
      leave(s.from, 0, s.start + reach);
      leave(s.to, 1, s.start + s.length - reach);
    }
    for (const auto& [corner, leaving] : at_corner)
      for (std::size_t i = 0; i < leaving.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          if (leaving[i].stretch == leaving[j].stretch) continue;  // a loop with one corner
          const double angle = geom::angle_between(leaving[i].direction, leaving[j].direction);
          if (!(angle < std::numbers::pi / 3)) continue;
          for (const Leaving& l : {leaving[i], leaving[j]}) {
            double& stretch = stretches_[l.stretch].stretch_at_end[l.end];
            stretch = std::max(stretch, first_gap(angle));
          }
        }
  }

  const TriMesh& mesh_;
  const Features& features_;
  std::vector<CurveMetric> metrics_;
  geom::Table<VertexId, double> shares_;  ///< of the plane's angle around each vertex
  geom::Table<VertexId, FacetId> facet_;
  std::vector<SurfaceSample> samples_;
  std::size_t num_fixed_ = 0;
  std::map<std::array<double, 3>, SiteId> at_;
  std::map<VertexId, SiteId> corner_;
  std::vector<Stretch> stretches_;
  std::vector<Staggered> staggered_;
  double missing_shares_ = 0;
};

/// The first samples beside corners with small angles: on all curves that make one as far from it in space as
/// on the densest of them.
class Shells {
 public:
  Shells(const Layout& layout, std::span<const std::size_t> edges) : layout_(layout) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Stretch& s = layout.stretches()[i];
      double parts = static_cast<double>(edges[i]);
      for (const double stretch : s.stretch_at_end) parts += stretch > 0 ? stretch - 1 : 0;
      for (const std::size_t end : {0, 1}) {
        if (!(s.stretch_at_end[end] > 0) || edges[i] < 2) continue;
        const double radius = distance(s, end, s.length / parts * s.stretch_at_end[end]);
        const auto [at, is_new] = radius_.try_emplace(corner(s, end), radius);
        at->second = std::min(at->second, radius);
      }
    }
  }

  /// Moves the first and last place of a stretch there and spaces the others evenly between.
  void keep(const Stretch& s, std::vector<double>& places) const {
    const bool at_start = has_shell(s, 0), at_end = has_shell(s, 1);
    if (places.empty() || (!at_start && !at_end)) return;
    const double first = at_start ? along(s, 0) : 0, last = s.length - (at_end ? along(s, 1) : 0);
    if (places.size() == 1) {
      places[0] = at_start && at_end ? (first + last) / 2 : at_start ? first : last;
      return;
    }
    // Between the shells, or from an end without one.
    const std::size_t gaps = places.size() - 1 + (at_start ? 0 : 1) + (at_end ? 0 : 1);
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] =
          first + (last - first) * static_cast<double>(i + (at_start ? 0 : 1)) / static_cast<double>(gaps);
  }

 private:
  static SiteId corner(const Stretch& s, std::size_t end) { return end == 0 ? s.from : s.to; }
  bool has_shell(const Stretch& s, std::size_t end) const {
    return s.stretch_at_end[end] > 0 && radius_.contains(corner(s, end));
  }
  /// In space from the corner at an end of the place t from there.
  double distance(const Stretch& s, std::size_t end, double t) const {
    const CurveMetric& metric = layout_.metric(s.curve);
    double at = end == 0 ? s.start + t : s.start + s.length - t;
    if (at >= metric.length() && s.start + s.length > metric.length()) at -= metric.length();
    return (metric.at(at).position - layout_.samples()[corner(s, end).index()].position).norm();
  }
  /// From the corner to its shell along a stretch, at most half of it.
  double along(const Stretch& s, std::size_t end) const {
    double low = 0, high = s.length / 2;
    const double radius = radius_.at(corner(s, end));
    for (int step = 0; step < 50; ++step) {
      const double t = (low + high) / 2;
      (distance(s, end, t) < radius ? low : high) = t;
    }
    return (low + high) / 2;
  }

  const Layout& layout_;
  std::map<SiteId, double> radius_;
};

/// Of a staggered curve, in edges of the leading one, by the width in these: half an edge where the strip is
/// so narrow that it must, more where it need not, for the sake of what is on the other side.
double end_gap(double width) { return std::clamp(1.5 * width, 0.5, 0.62); }

/// Opposite to the middles of the leading stretch's edges, or about so near its ends. None if the surface
/// does not let them be apart.
std::vector<double> staggered_places(const Layout& layout, const Staggered& pair,
                                     const std::vector<double>& leading) {
  const Stretch &a = layout.stretches()[pair.leading], &b = layout.stretches()[pair.staggered];
  std::vector<double> stops = leading, places;
  const bool is_loop = !a.from.valid();
  if (!is_loop) stops.insert(stops.begin(), 0);
  stops.push_back(is_loop ? leading.front() + a.length : a.length);
  const double edges = static_cast<double>(stops.size() - 1);
  const double first = is_loop ? 0.5 : end_gap(pair.width_share * edges);
  const double gap = stops.size() > 2 && !is_loop ? (edges - 2 * first) / (edges - 1) : 1;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const double phase = stops.size() == 2 ? 0.5 : first + gap * static_cast<double>(k);
    const auto i = std::min(static_cast<std::size_t>(phase), stops.size() - 2);
    const double t = stops[i] + (phase - static_cast<double>(i)) * (stops[i + 1] - stops[i]);
    const Vec3 x = layout.metric(a.curve).at(t < a.length ? t : t - a.length).position;
    places.push_back(layout.metric(b.curve).nearest(x).t);
  }
  std::ranges::sort(places);
  const double least_gap = 0.3 * b.length / static_cast<double>(places.size());
  double before = b.from.valid() ? 0 : places.back() - b.length;
  for (const double t : places) {
    if (t - before < least_gap) return {};
    before = t;
  }
  if (b.from.valid() && b.length - before < least_gap) return {};
  return places;
}

/// Where on each stretch its samples are, and how many stretches are staggered.
struct PlacesAlong {
  std::vector<std::vector<double>> of;
  std::size_t staggered = 0;
};

PlacesAlong places_along(const Layout& layout, std::span<const std::size_t> edges, std::uint64_t seed) {
  const Shells shells(layout, edges);
  PlacesAlong result;
  std::vector<std::vector<double>>& places = result.of;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Stretch& s = layout.stretches()[i];
    places.push_back(even_places(s.length, !s.from.valid(), edges[i] - (s.from.valid() ? 1 : 0), seed + i));
    shells.keep(s, places[i]);
  }
  for (const Staggered& pair : layout.staggered()) {
    if (!layout.is_staggered(pair, edges)) continue;
    std::vector<double> opposite = staggered_places(layout, pair, places[pair.leading]);
    if (opposite.empty()) continue;
    places[pair.staggered] = std::move(opposite);
    ++result.staggered;
  }
  return result;
}

/// Edges of each stretch, if lengths are so many times those that are wanted.
struct StretchedEdges {
  std::vector<std::size_t> edges;
  double stretching;
};

/// The least stretching, in steps, with which the features take no more than `most` samples.
StretchedEdges affordable_edges(const Layout& layout, std::size_t most) {
  geom::require(layout.least() <= most, std::to_string(most) + (most == 1 ? " sample is" : " samples are") +
                                            " too few: the features need at least " +
                                            std::to_string(layout.least()));
  for (double stretching = 1;; stretching *= 1.02) {
    std::vector<std::size_t> edges = layout.edges(stretching);
    if (layout.num_samples(edges) <= most) return {std::move(edges), stretching};
  }
}

}  // namespace

std::size_t wanted_edges(double length) {
  const double edges = std::max(1.0, std::round(length));
  return static_cast<std::size_t>(length > longest_edge * edges ? edges + 1 : edges);
}

std::size_t least_number_of_samples(const TriMesh& mesh, const Features& features,
                                    std::span<const SurfaceSample> fixed) {
  return Layout(mesh, features, fixed, Sizing::uniform(1)).least();
}

namespace {

/// With so many edges on each stretch.
FeatureSamples placed(const Layout& layout, const Features& features, std::span<const std::size_t> edges,
                      std::uint64_t seed, ChainPlaces& chain_places) {
  const PlacesAlong places = places_along(layout, edges, seed);
  FeatureSamples result{layout.samples(), {}, {}, layout.missing_shares(), layout.samples().size(),
                        places.staggered};
  result.chains.resize(features.curves.size());
  for (const FeatureCurve& curve : features.curves) result.sheets.push_back(curve.sheets);
  chain_places.assign(features.curves.size(), {});
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Stretch& s = layout.stretches()[i];
    const CurveMetric& metric = layout.metric(s.curve);
    std::vector<SiteId>& chain = result.chains[s.curve];
    std::vector<double>& on_chain = chain_places[s.curve];
    if (s.from.valid() && chain.empty()) chain.push_back(s.from), on_chain.push_back(s.start);
    for (const double t : places.of[i]) {
      chain.emplace_back(result.samples.size()), on_chain.push_back(s.start + t);
      result.samples.push_back(
          metric.at(s.start + t < metric.length() ? s.start + t : s.start + t - metric.length()));
      result.missing_shares += 1 - static_cast<double>(features.curves[s.curve].sheets) / 2;
    }
    chain.push_back(s.from.valid() ? s.to : chain.front());
    on_chain.push_back(s.from.valid() ? s.start + s.length : on_chain.front() + s.length);
  }
  return result;
}

/// Samples that are added to face others need room. Where most samples are on curves those that are left over
/// would have none between: fewer are placed at first, until all find it.
FeatureSamples facing_samples(const Layout& layout, const TriMesh& mesh, const Features& features,
                              const Sizing& sizing, const CurveSampling& options) {
  std::optional<FeatureSamples> best;
  std::size_t fewest = 0;
  FacingLimits limits{options.most, 0};
  for (double share = 1; share > least_share; share -= share_step) {
    const auto budget = static_cast<std::size_t>(share * static_cast<double>(options.most));
    const auto [edges, stretching] = affordable_edges(layout, std::max(budget, layout.least()));
    if (share == 1 && 2 * layout.num_samples(layout.edges(1)) > options.most) {
      const double between = InnerShare(mesh, features, sizing, stretching).num_samples();
      limits.wanted = static_cast<std::size_t>(std::max(0.0, static_cast<double>(options.most) - between));
    }
    ChainPlaces places;
    FeatureSamples samples = placed(layout, features, edges, options.seed, places);
    const std::size_t crowded =
        face_each_other(features, layout.metrics(), std::move(places), limits, samples);
    if (!best || crowded < fewest) best = std::move(samples), fewest = crowded;
    if (crowded == 0 || limits.wanted == 0) break;
  }
  return std::move(*best);
}

}  // namespace

FeatureSamples sample_features(const TriMesh& mesh, const Features& features,
                               std::span<const SurfaceSample> fixed, const Sizing& sizing,
                               const CurveSampling& options) {
  Layout layout(mesh, features, fixed, sizing);
  if (options.facing) return facing_samples(layout, mesh, features, sizing, options);
  layout.stagger(options.pairs);
  if (layout.least() > options.most) layout.stagger({});  // it takes a sample more a curve
  ChainPlaces places;
  return placed(layout, features, affordable_edges(layout, options.most).edges, options.seed, places);
}

SharedSizing share_sizing(const TriMesh& mesh, const Features& features, std::span<const SurfaceSample> fixed,
                          const std::function<Sizing(std::size_t)>& sizing_for, CurveSampling sampling) {
  constexpr int rounds = 4;
  const std::size_t n = sampling.most;
  std::vector<FacingPair> pairs;
  if (!features.curves.empty() && sampling.staggered && !sampling.facing)
    pairs = facing_pairs(mesh, features, narrow_places(mesh, features, hexagonal_spacing(mesh.area(), n)));
  sampling.pairs = pairs;
  std::size_t wanted = n;
  for (int round = 1;; ++round) {
    SharedSizing result{sizing_for(wanted), {}};
    result.features = sample_features(mesh, features, fixed, result.sizing, sampling);
    const auto next = static_cast<std::size_t>(
        std::max(1.0, static_cast<double>(n) - std::round(result.features.missing_shares)));
    if (next == wanted || round == rounds) return result;
    wanted = next;
  }
}

namespace {

template <class Visit>
void for_each_edge(const FeatureSamples& features, Visit visit) {
  for (const std::vector<SiteId>& chain : features.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) visit(chain[i], chain[i + 1]);
}

}  // namespace

std::size_t num_edges(const FeatureSamples& features) {
  std::size_t sum = 0;
  for_each_edge(features, [&](SiteId, SiteId) { ++sum; });
  return sum;
}

std::vector<std::pair<SiteId, SiteId>> broken_edges(const TriMesh& remesh, const FeatureSamples& features) {
  const std::vector<geom::MeshEdge> edges = geom::edges_of(remesh);
  std::vector<std::pair<SiteId, SiteId>> broken;
  for_each_edge(features, [&](SiteId a, SiteId b) {
    const geom::MeshEdge edge = geom::mesh_edge(VertexId(a.value), VertexId(b.value));
    if (!std::ranges::binary_search(edges, edge)) broken.emplace_back(a, b);
  });
  return broken;
}

}  // namespace fpo
