#include "fpo/features/facing_samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "geom/exact/exact_vector.h"
#include "geom/exact/filters.h"

namespace fpo {

using geom::SiteId;
using geom::Vec3;

namespace {

constexpr int rounds = 20, patient_rounds = 12;  // nothing slides in the later ones
constexpr double near = 0.35;                    // of an edge: its end goes there
constexpr double least_piece = 0.02;  // of an edge that is divided, or of the distance that is seen
constexpr double widest_gap = 1.5;    // of the mean gap around, that a slide may leave
constexpr double longest = 1.25;      // in wanted lengths
constexpr int bisections = 40;
constexpr std::size_t most_fillings = 200;  // edges
constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Samples by one coordinate.
class Slab {
 public:
  explicit Slab(const std::vector<SurfaceSample>& samples) {
    Vec3 low = samples.front().position, high = low;
    for (const SurfaceSample& x : samples) low = low.cwiseMin(x.position), high = high.cwiseMax(x.position);
    (high - low).maxCoeff(&axis_);
    for (std::size_t i = 0; i < samples.size(); ++i) add(samples[i].position, SiteId(i));
  }
  void add(const Vec3& at, SiteId x) { sorted_.emplace(at[axis_], x); }
  void remove(const Vec3& at, SiteId x) { sorted_.erase({at[axis_], x}); }

  template <class Visit>
  void around(const Vec3& a, const Vec3& b, Visit visit) const {
    const double middle = (a[axis_] + b[axis_]) / 2, reach = (b - a).norm();
    for (auto at = sorted_.lower_bound({middle - reach, SiteId(0)});
         at != sorted_.end() && at->first <= middle + reach; ++at)
      visit(at->second);
  }

 private:
  Eigen::Index axis_ = 0;
  std::set<std::pair<double, SiteId>> sorted_;
};

/// The chains as they are, to be looked at.
struct Chains {
  std::span<const CurveMetric> metrics;
  const ChainPlaces& places;
  const FeatureSamples& samples;

  const Vec3& position(SiteId x) const { return samples.samples[x.index()].position; }
  SurfaceSample at(std::size_t c, double t) const {
    const double length = metrics[c].length();
    return metrics[c].at(t > length ? t - length : t < 0 ? t + length : t);
  }

  /// Between sample i and the next: as far from both.
  double middle(std::size_t c, std::size_t i) const {
    const Vec3 &a = position(samples.chains[c][i]), &b = position(samples.chains[c][i + 1]);
    double low = places[c][i], high = places[c][i + 1];
    for (int step = 0; step < bisections; ++step) {
      const double t = (low + high) / 2;
      const Vec3 x = at(c, t).position;
      ((x - a).squaredNorm() < (x - b).squaredNorm() ? low : high) = t;
    }
    return (low + high) / 2;
  }

  std::optional<SiteId> intruder(const Slab& slab, std::size_t c, std::size_t i) const {
    const SiteId a = samples.chains[c][i], b = samples.chains[c][i + 1];
    const double size2 = (position(b) - position(a)).squaredNorm();
    const Vec3 between = (position(a) + position(b)) / 2;
    std::optional<Vec3> m;
    std::optional<std::pair<double, SiteId>> nearest;
    slab.around(position(a), position(b), [&](SiteId x) {
      if (x == a || x == b || (position(x) - between).squaredNorm() > size2) return;
      if (!m) m = at(c, middle(c, i)).position;
      if (!is_as_near(*m, position(a), position(x)) && !is_as_near(*m, position(b), position(x))) return;
      const std::pair found((position(x) - *m).squaredNorm(), x);
      if (!nearest || found < *nearest) nearest = found;
    });
    return nearest ? std::optional(nearest->second) : std::nullopt;
  }
};

class FacingSamples {
 public:
  FacingSamples(const Features& features, std::span<const CurveMetric> metrics, ChainPlaces places,
                FeatureSamples& samples)
      : features_(features),
        places_(std::move(places)),
        samples_(samples),
        look_{metrics, places_, samples},
        slab_(samples.samples),
        faces_(samples.samples.size(), 0),
        curve_of_(samples.samples.size(), none) {
    for (std::size_t c = 0; c < samples.chains.size(); ++c)
      for (const SiteId x : samples.chains[c])
        if (x.index() >= samples.num_given) curve_of_[x] = c;
  }

  void run(std::size_t most) {
    bool changed = true;
    for (int round = 0; round < rounds && changed; ++round) {
      changed = false;
      for (std::size_t c = 0; c < samples_.chains.size(); ++c)
        for (std::size_t i = 0; i + 1 < samples_.chains[c].size(); ++i)
          changed |= clear(c, i, round < patient_rounds, most);
      if (!changed) changed = divide_long_edges(most);
    }
  }
  const ChainPlaces& places() const { return places_; }

  /// Of no edge that is crowded.
  void fill(std::size_t wanted) {
    struct Edge {
      double length;
      std::size_t curve;
      SiteId from;
    };
    std::vector<Edge> edges;
    for (std::size_t c = 0; c < samples_.chains.size(); ++c)
      for (std::size_t i = 0; i + 1 < samples_.chains[c].size(); ++i)
        edges.push_back({places_[c][i + 1] - places_[c][i], c, samples_.chains[c][i]});
    std::ranges::stable_sort(edges, std::greater<>(), &Edge::length);
    edges.resize(std::min(edges.size(), most_fillings));
    for (const Edge& edge : edges) {
      const std::size_t before = samples_.samples.size();
      if (before >= wanted) return;
      const std::vector<SiteId>& chain = samples_.chains[edge.curve];
      const std::vector<double>& t = places_[edge.curve];
      const auto i = static_cast<std::size_t>(std::ranges::find(chain, edge.from) - chain.begin());
      if (t[i + 1] - t[i] < edge.length) continue;  // it is divided already
      insert(edge.curve, i, look_.middle(edge.curve, i));
      if (!clear_by_insertion(wanted)) remove_from(before);
    }
  }

 private:
  /// False if that takes more than `most` samples.
  bool clear_by_insertion(std::size_t most) {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t c = 0; c < samples_.chains.size(); ++c)
        for (std::size_t i = 0; i + 1 < samples_.chains[c].size(); ++i) {
          if (!look_.intruder(slab_, c, i)) continue;
          if (!clear(c, i, false, most)) return false;
          changed = true;
        }
    }
    return true;
  }

  /// Those that slides have left: inner samples would come between their ends.
  bool divide_long_edges(std::size_t most) {
    const std::size_t before = samples_.samples.size();
    for (std::size_t c = 0; c < samples_.chains.size(); ++c) {
      const std::vector<SiteId>& chain = samples_.chains[c];
      const double even = std::max(1.0, length(c) / static_cast<double>(chain.size() - 1));
      for (std::size_t i = 0; i + 1 < chain.size() && samples_.samples.size() < most; ++i) {
        if (!(places_[c][i + 1] - places_[c][i] > longest * even)) continue;
        if (!faces_[chain[i]] && !faces_[chain[i + 1]]) continue;
        insert(c, i, look_.middle(c, i));
      }
    }
    return samples_.samples.size() > before;
  }

  bool clear(std::size_t c, std::size_t i, bool may_slide, std::size_t most) {
    const std::vector<SiteId>& chain = samples_.chains[c];
    const std::optional<SiteId> x = look_.intruder(slab_, c, i);
    if (!x) return false;
    const double from = places_[c][i], to = places_[c][i + 1], foot = foot_of(c, from, to, position(*x));
    const double share = (foot - from) / (to - from), aside = std::min(share, 1 - share);
    const double size = (position(chain[i + 1]) - position(chain[i])).norm();
    if ((at(c, foot).position - position(*x)).norm() < least_piece * size) return false;
    const std::size_t end = share < 0.5 ? i : i + 1;
    const bool slid = may_slide && aside < near && aside > least_piece &&
                      (slide(c, end, foot) || slide_above(*x, chain[end]));
    if (!slid && samples_.samples.size() >= most) return false;
    if (!slid) insert(c, i, aside > least_piece ? foot : look_.middle(c, i));
    faces_[*x] = 1;
    return true;
  }

  const Vec3& position(SiteId x) const { return look_.position(x); }
  SurfaceSample at(std::size_t c, double t) const { return look_.at(c, t); }
  double length(std::size_t c) const { return look_.metrics[c].length(); }

  /// The place between two others that is nearest to x.
  double foot_of(std::size_t c, double from, double to, const Vec3& x) const {
    constexpr int parts = 16, steps = 40;
    const auto distance = [&](double t) { return (at(c, t).position - x).squaredNorm(); };
    const double part = (to - from) / parts;
    double best = from;
    for (int k = 1; k <= parts; ++k)
      if (distance(from + part * k) < distance(best)) best = from + part * k;
    double low = std::max(from, best - part), high = std::min(to, best + part);
    for (int step = 0; step < steps; ++step) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(a) <= distance(b) ? high : low) = distance(a) <= distance(b) ? b : a;
    }
    return (low + high) / 2;
  }

  /// Not one that faces another already, nor far from its other neighbour.
  bool can_slide(std::size_t c, std::size_t i, double foot) const {
    const std::vector<SiteId>& chain = samples_.chains[c];
    const std::vector<double>& t = places_[c];
    if (chain[i].index() < samples_.num_given || faces_[chain[i]]) return false;
    const bool closes = i == 0 || i + 1 == chain.size();
    const double before = closes ? t[chain.size() - 2] - (i == 0 ? length(c) : 0) : t[i - 1],
                 after = closes ? t[1] + (i == 0 ? 0 : length(c)) : t[i + 1];
    return std::max(foot - before, after - foot) < widest_gap * (after - before) / 2;
  }

  bool slide(std::size_t c, std::size_t i, double foot) {
    if (!can_slide(c, i, foot)) return false;
    const SiteId x = samples_.chains[c][i];
    slab_.remove(position(x), x);
    samples_.samples[x.index()] = at(c, foot);
    slab_.add(position(x), x);
    faces_[x] = 1;
    std::vector<double>& t = places_[c];
    t[i] = foot;
    if (i == 0) t.back() = foot + length(c);
    if (i + 1 == t.size()) t.front() = foot - length(c);
    return true;
  }

  /// x goes to the foot of another sample on its own curve, where that can move neither.
  bool slide_above(SiteId x, SiteId other) {
    const std::size_t c = curve_of_[x];
    if (c == none) return false;
    const std::vector<SiteId>& chain = samples_.chains[c];
    const auto i = static_cast<std::size_t>(std::ranges::find(chain, x) - chain.begin());
    const double t = places_[c][i],
                 foot = i > 0 ? foot_of(c, places_[c][i - 1], places_[c][i + 1], position(other))
                              : foot_of(c, t, places_[c][1], position(other));
    return foot != t && slide(c, i, foot);
  }

  /// The samples that were inserted since there were so many.
  void remove_from(std::size_t first) {
    for (std::size_t c = 0; c < samples_.chains.size(); ++c) {
      std::vector<SiteId>& chain = samples_.chains[c];
      for (std::size_t i = chain.size(); i-- > 0;) {
        if (chain[i].index() < first) continue;
        chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(i));
        places_[c].erase(places_[c].begin() + static_cast<std::ptrdiff_t>(i));
        samples_.missing_shares -= 1 - static_cast<double>(features_.curves[c].sheets) / 2;
      }
    }
    for (std::size_t i = first; i < samples_.samples.size(); ++i)
      slab_.remove(position(SiteId(i)), SiteId(i));
    samples_.samples.resize(first), faces_.resize(first), curve_of_.resize(first);
  }

  void insert(std::size_t c, std::size_t i, double foot) {
    const SiteId x(samples_.samples.size());
    samples_.samples.push_back(at(c, foot));
    samples_.missing_shares += 1 - static_cast<double>(features_.curves[c].sheets) / 2;
    samples_.chains[c].insert(samples_.chains[c].begin() + static_cast<std::ptrdiff_t>(i) + 1, x);
    places_[c].insert(places_[c].begin() + static_cast<std::ptrdiff_t>(i) + 1, foot);
    slab_.add(position(x), x);
    faces_.push_back(1);
    curve_of_.push_back(c);
  }

  const Features& features_;
  ChainPlaces places_;
  FeatureSamples& samples_;
  Chains look_;
  Slab slab_;
  geom::Table<SiteId, char> faces_;            ///< is at a foot, or above one
  geom::Table<SiteId, std::size_t> curve_of_;  ///< none: one that stays
};

}  // namespace

// With u = a - x the difference of the squares is u . (2 c - a - x). In doubles: a difference, two and a sum,
// a product, two sums: six roundings (filters.h).
bool is_as_near(const Vec3& c, const Vec3& a, const Vec3& x) {
  const Vec3 u = a - x, v = c - a, w = c - x;
  const double value = u.dot(v + w);
  const double bound = geom::filter::error_of(6) * u.cwiseAbs().dot(v.cwiseAbs() + w.cwiseAbs());
  if (std::abs(value) > bound) return value < 0;
  const geom::ExactVec3 sum = geom::exact_difference(c, a) + geom::exact_difference(c, x);
  return geom::dot(geom::exact_difference(a, x), sum).sign() <= 0;
}

std::vector<CrowdedEdge> crowded_edges(std::span<const CurveMetric> metrics, const ChainPlaces& places,
                                       const FeatureSamples& samples) {
  std::vector<CrowdedEdge> result;
  if (samples.samples.empty()) return result;
  const Slab slab(samples.samples);
  const Chains chains{metrics, places, samples};
  for (std::size_t c = 0; c < samples.chains.size(); ++c)
    for (std::size_t i = 0; i + 1 < samples.chains[c].size(); ++i)
      if (const auto x = chains.intruder(slab, c, i)) result.push_back({c, i, *x});
  return result;
}

std::size_t face_each_other(const Features& features, std::span<const CurveMetric> metrics,
                            ChainPlaces places, const FacingLimits& limits, FeatureSamples& samples) {
  if (crowded_edges(metrics, places, samples).empty()) return 0;
  FacingSamples facing(features, metrics, std::move(places), samples);
  facing.run(limits.most);
  const std::size_t crowded = crowded_edges(metrics, facing.places(), samples).size();
  if (crowded == 0) facing.fill(limits.wanted);
  return crowded;
}

}  // namespace fpo
