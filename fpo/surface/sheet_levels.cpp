#include "fpo/surface/sheet_levels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "fpo/surface/fitted_parts.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/scaling.h"
#include "geom/sites/site_tree.h"

namespace fpo {
namespace {

using geom::SiteId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double probe_spacing = 0.35;  // in wanted lengths
constexpr double patch_radius = 3;
constexpr double most_parts = 500;  // of facets, a sample
constexpr double step =
    1.25;  // levels are powers of it, so that patches of about the same sizes have the same

/// Places and how far those beside each other are.
class Graph {
 public:
  Graph() = default;
  /// for_each_pair(visit) calls visit(a, b) for all who are beside each other, once or more often, twice the
  /// same. `length(a, b)`: between them.
  template <class Pairs, class Length>
  Graph(std::size_t size, const Pairs& for_each_pair, const Length& length) : begin_(size + 1, 0) {
    for_each_pair([&](std::size_t a, std::size_t b) { ++begin_[a], ++begin_[b]; });
    std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
    to_.resize(begin_.back());
    for_each_pair([&](std::size_t a, std::size_t b) {
      to_[--begin_[a]] = static_cast<std::uint32_t>(b);
      to_[--begin_[b]] = static_cast<std::uint32_t>(a);
    });
    drop_doubles();
    lengths_.reserve(to_.size());
    for (std::size_t a = 0; a < size; ++a)
      for (const std::uint32_t b : beside(a)) lengths_.push_back(length(a, b));
  }
  std::size_t size() const { return begin_.size() - 1; }
  /// Ascending.
  std::span<const std::uint32_t> beside(std::size_t a) const {
    return {to_.data() + begin_[a], to_.data() + begin_[a + 1]};
  }
  /// How far these are, in the same order.
  const double* lengths(std::size_t a) const { return lengths_.data() + begin_[a]; }

 private:
  /// Sorts the lists.
  void drop_doubles() {
    std::size_t kept = 0;
    for (std::size_t a = 0; a + 1 < begin_.size(); ++a) {
      const auto first = to_.begin() + static_cast<std::ptrdiff_t>(begin_[a]),
                 last = to_.begin() + static_cast<std::ptrdiff_t>(begin_[a + 1]);
      std::sort(first, last);
      begin_[a] = kept;
      const auto end = std::unique_copy(first, last, to_.begin() + static_cast<std::ptrdiff_t>(kept));
      kept = static_cast<std::size_t>(end - to_.begin());
    }
    begin_.back() = kept;
    to_.resize(kept);
    to_.shrink_to_fit();
  }

  std::vector<std::size_t> begin_{0};  ///< of each list; then the end
  std::vector<std::uint32_t> to_;
  std::vector<double> lengths_;
};

/// Dijkstra's search from places with distances to begin with, over and over.
class Search {
 public:
  explicit Search(const Graph& graph) : graph_(graph), distance_(graph.size(), infinity) {}

  /// Calls visit(place, distance), nearest first, until it says false: then it goes no further from there.
  /// `limit`: not beyond.
  template <class Visit>
  void run(std::span<const std::pair<std::uint32_t, double>> from, double limit, Visit visit) {
    for (const std::uint32_t v : touched_) distance_[v] = infinity;
    touched_.clear();
    for (const auto& [v, d] : from) offer(v, d);
    while (!queue_.empty()) {
      const auto [d, v] = queue_.top();
      queue_.pop();
      if (d > distance_[v] || !visit(v, d)) continue;
      const double* length = graph_.lengths(v);
      for (const std::uint32_t to : graph_.beside(v)) {
        if (d + *length <= limit) offer(to, d + *length);
        ++length;
      }
    }
  }
  /// Of the last search; infinite: not reached.
  double distance(std::uint32_t v) const { return distance_[v]; }

 private:
  void offer(std::uint32_t v, double d) {
    if (!(d < distance_[v])) return;
    if (distance_[v] == infinity) touched_.push_back(v);
    distance_[v] = d;
    queue_.push({d, v});
  }
  using Entry = std::pair<double, std::uint32_t>;
  const Graph& graph_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> touched_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

Graph edges_of(const TriMesh& mesh) {
  const auto edges = [&](const auto& visit) {
    for (const TriMesh::Facet& facet : mesh.facets())
      for (std::size_t e = 0; e < 3; ++e) visit(facet[e].index(), facet[(e + 1) % 3].index());
  };
  return Graph(mesh.num_vertices(), edges, [&](std::size_t a, std::size_t b) {
    return (mesh.position(VertexId(a)) - mesh.position(VertexId(b))).norm();
  });
}

/// One assignment of levels.
class SheetLevels {
 public:
  SheetLevels(const TriMesh& mesh, std::vector<double> h, const SheetOptions& options)
      : mesh_(mesh), h_(std::move(h)), options_(options), graph_(edges_of(mesh)) {}

  /// Empty: no places are in conflict.
  Table<VertexId, double> find() {
    place_probes();
    find_conflicts();
    if (conflicts_.empty()) return {};
    part_components();
    make_patches();
    color_patches();
    return levels();
  }

 private:
  void place_probes();
  void find_conflicts();
  void part_components();
  void make_patches();
  void color_patches();
  Table<VertexId, double> levels();
  bool is_suspicious(std::size_t a, std::size_t b) const;
  double h_of(std::size_t probe) const { return h_[probes_[probe].vertex]; }
  /// A length no less, one of few.
  static double rounded_up(double length) {
    return std::pow(step, std::ceil(std::log(length) / std::log(step) - 1e-9));
  }

  struct Probe {
    std::uint32_t vertex, component;
    Vec3 position, normal;
  };
  const TriMesh& mesh_;
  std::vector<double> h_;  ///< of vertices
  SheetOptions options_;
  Graph graph_;  ///< of vertices
  std::vector<Probe> probes_;
  std::vector<std::uint32_t> probe_of_;  ///< of each vertex
  Graph near_;                           ///< of probes
  std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts_;
  std::vector<double> base_;                             ///< level of each component
  std::vector<std::vector<std::uint32_t>> in_conflict_;  ///< with each probe, of its component
  std::vector<int> patch_of_;                            ///< of each probe, or -1
  std::vector<double> patch_height_;
  std::vector<int> color_;  ///< of each patch
};

/// Vertices about evenly spread along the surface, and which of them are beside each other.
void SheetLevels::place_probes() {
  geom::DisjointSets components(mesh_.num_vertices());
  Table<VertexId, Vec3> normals(mesh_.num_vertices(), Vec3(0, 0, 0));
  for (geom::FacetId t(0); t.index() < mesh_.num_facets(); t = geom::FacetId(t.value + 1))
    for (const VertexId v : mesh_.facet(t)) {
      normals[v] += mesh_.normal(t);
      components.merge(mesh_.facet(t)[0].index(), v.index());
    }
  std::vector<double> known(graph_.size(), infinity);
  probe_of_.assign(graph_.size(), 0);
  Search search(graph_);
  for (std::uint32_t v = 0; v < graph_.size(); ++v) {
    if (known[v] <= probe_spacing * h_[v] || graph_.beside(v).empty()) continue;
    const auto probe = static_cast<std::uint32_t>(probes_.size());
    probes_.push_back({v, static_cast<std::uint32_t>(components.find(v)),
                       mesh_.position(VertexId(std::size_t{v})),
                       normals[VertexId(std::size_t{v})].normalized()});
    const std::pair<std::uint32_t, double> from{v, 0};
    search.run(std::span(&from, 1), 2 * probe_spacing * h_[v], [&](std::uint32_t u, double d) {
      if (!(d < known[u])) return false;
      known[u] = d;
      probe_of_[u] = probe;
      return true;
    });
  }
  const auto pairs = [&](const auto& visit) {
    for (std::uint32_t v = 0; v < graph_.size(); ++v)
      for (const std::uint32_t to : graph_.beside(v))
        if (probe_of_[v] < probe_of_[to]) visit(probe_of_[v], probe_of_[to]);
  };
  near_ = Graph(probes_.size(), pairs, [&](std::size_t a, std::size_t b) {
    return (probes_[a].position - probes_[b].position).norm();
  });
}

/// Not simply beside each other on one sheet?
bool SheetLevels::is_suspicious(std::size_t a, std::size_t b) const {
  const Vec3 d = probes_[b].position - probes_[a].position;
  const double across = std::max(std::abs(d.dot(probes_[a].normal)), std::abs(d.dot(probes_[b].normal)));
  return probes_[a].component != probes_[b].component || probes_[a].normal.dot(probes_[b].normal) < 0.5 ||
         across > 0.5 * d.norm();
}

void SheetLevels::find_conflicts() {
  geom::SiteTree tree;
  for (std::size_t i = 0; i < probes_.size(); ++i) tree.insert(SiteId(i), {probes_[i].position});
  Search search(near_);
  std::vector<SiteId> around;
  for (std::uint32_t a = 0; a < probes_.size(); ++a) {
    around.clear();
    const double radius = options_.near * h_of(a);
    tree.heirs({SiteId(std::size_t{a}), probes_[a].position, radius, 0}, around);
    std::erase_if(around, [&](SiteId b) {
      return b.index() == a || (probes_[b.index()].position - probes_[a].position).norm() > radius ||
             !is_suspicious(a, b.index());
    });
    if (around.empty()) continue;
    std::ranges::sort(around);
    const std::pair<std::uint32_t, double> from{a, 0};
    search.run(std::span(&from, 1), options_.far * h_of(a), [](std::uint32_t, double) { return true; });
    for (const SiteId b : around)
      if (search.distance(static_cast<std::uint32_t>(b.index())) == infinity)
        conflicts_.emplace_back(a, static_cast<std::uint32_t>(b.index()));
  }
}

/// Components in conflict get different levels; what is left in conflict is so within components.
void SheetLevels::part_components() {
  std::map<std::uint32_t, std::set<std::uint32_t>> apart;
  double largest = 0;
  for (const auto& [a, b] : conflicts_) {
    largest = std::max({largest, h_of(a), h_of(b)});
    const std::uint32_t one = probes_[a].component, two = probes_[b].component;
    if (one != two) apart[one].insert(two), apart[two].insert(one);
  }
  base_.assign(mesh_.num_vertices(), 0);
  std::map<std::uint32_t, int> color;
  // Inside a component there may be levels, too: room for three colors of those.
  const double height = 3 * rounded_up(options_.height * largest);
  for (const auto& [component, others] : apart) {
    std::set<int> taken;
    for (const std::uint32_t other : others)
      if (color.contains(other)) taken.insert(color[other]);
    int c = 0;
    while (taken.contains(c)) ++c;
    color[component] = c;
    base_[component] = c * height;
  }
  in_conflict_.resize(probes_.size());
  for (const auto& [a, b] : conflicts_)
    if (probes_[a].component == probes_[b].component) {
      in_conflict_[a].push_back(b);
      in_conflict_[b].push_back(a);
    }
}

/// Probes in conflict, in connected sets that are not too large.
void SheetLevels::make_patches() {
  patch_of_.assign(probes_.size(), -1);
  Search search(near_);
  for (std::uint32_t seed = 0; seed < probes_.size(); ++seed) {
    if (in_conflict_[seed].empty() || patch_of_[seed] >= 0) continue;
    const int patch = static_cast<int>(patch_height_.size());
    double largest = 0;
    const std::pair<std::uint32_t, double> from{seed, 0};
    search.run(std::span(&from, 1), patch_radius * h_of(seed), [&](std::uint32_t v, double) {
      if (in_conflict_[v].empty() || patch_of_[v] >= 0) return false;
      patch_of_[v] = patch;
      largest = std::max(largest, h_of(v));
      return true;
    });
    patch_height_.push_back(rounded_up(options_.height * largest));
  }
}

/// One after the other, from patch to patch beside it: the color nearest to that of those beside it that none
/// in conflict with it has.
void SheetLevels::color_patches() {
  const std::size_t n = patch_height_.size();
  std::vector<std::set<int>> beside(n), against(n);
  for (std::uint32_t a = 0; a < probes_.size(); ++a) {
    if (patch_of_[a] < 0) continue;
    const auto p = static_cast<std::size_t>(patch_of_[a]);
    for (const std::uint32_t b : near_.beside(a))
      if (patch_of_[b] >= 0 && patch_of_[b] != patch_of_[a]) beside[p].insert(patch_of_[b]);
    for (const std::uint32_t b : in_conflict_[a])
      if (patch_of_[b] != patch_of_[a]) against[p].insert(patch_of_[b]);
  }
  constexpr int none = std::numeric_limits<int>::max();
  color_.assign(n, none);
  std::vector<int> waiting;
  const auto give_color = [&](std::size_t p, int wanted) {
    const auto is_free = [&](int c) {
      return std::ranges::none_of(against[p],
                                  [&](int q) { return color_[static_cast<std::size_t>(q)] == c; });
    };
    for (int off = 0; color_[p] == none; ++off)
      for (const int c : std::abs(wanted - off) < std::abs(wanted + off)
                             ? std::array{wanted - off, wanted + off}
                             : std::array{wanted + off, wanted - off})
        if (color_[p] == none && is_free(c)) color_[p] = c;
    waiting.push_back(static_cast<int>(p));
  };
  for (std::size_t first = 0; first < n; ++first) {
    if (color_[first] != none) continue;
    give_color(first, 0);
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const auto p = static_cast<std::size_t>(waiting[i]);
      for (const int q : beside[p])
        if (color_[static_cast<std::size_t>(q)] == none) give_color(static_cast<std::size_t>(q), color_[p]);
    }
    waiting.clear();
  }
}

Table<VertexId, double> SheetLevels::levels() {
  using Source = std::pair<std::uint32_t, double>;
  std::vector<Source> wishes;  // levels above that of the component
  for (std::uint32_t v = 0; v < graph_.size(); ++v)
    if (const std::uint32_t probe = probe_of_[v]; !graph_.beside(v).empty() && patch_of_[probe] >= 0) {
      const auto p = static_cast<std::size_t>(patch_of_[probe]);
      wishes.emplace_back(v, color_[p] * patch_height_[p]);
    }
  std::vector<double> low(graph_.size()), high(graph_.size());
  Search search(graph_);
  // Searched in lengths: U / g = min (t / g + d), which may begin below 0, and L / g = -min (-t / g + d).
  const auto extend = [&](double sign, std::vector<double>& out) {
    std::vector<Source> from = wishes;
    for (auto& [v, t] : from) t *= sign / options_.slope;
    std::ranges::fill(out, infinity);
    search.run(from, infinity, [&](std::uint32_t v, double d) { return out[v] = d, true; });
  };
  const auto find_bounds = [&] { extend(1, high), extend(-1, low); };
  find_bounds();
  const std::size_t num_wishes = wishes.size();
  std::vector<char> has_wish(graph_.size(), 0);
  for (std::size_t i = 0; i < num_wishes; ++i) has_wish[wishes[i].first] = 1;
  for (std::uint32_t v = 0; v < graph_.size(); ++v)
    if (!has_wish[v] && high[v] >= 0 && low[v] >= 0) wishes.emplace_back(v, 0);  // 0 is as good as any
  find_bounds();
  std::vector<double> wish(graph_.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& [v, t] : wishes) wish[v] = t;
  Table<VertexId, double> result(graph_.size(), 0.0);
  for (std::uint32_t v = 0; v < graph_.size(); ++v) {
    if (graph_.beside(v).empty()) continue;
    const double g = options_.slope, t = wish[v];
    const bool is_granted = high[v] == t / g && low[v] == -t / g;  // else it takes what the others leave
    const double level = is_granted ? t : 0.5 * g * (high[v] - low[v]);
    result[VertexId(std::size_t{v})] =
        geom::snapped(base_[probes_[probe_of_[v]].component] + level, geom::coordinate_unit);
  }
  return result;
}

}  // namespace

std::optional<SplitSurface> sheets_apart(const TriMesh& mesh, const Sizing& sizing,
                                         std::span<SurfaceSample> samples, const SheetOptions& options) {
  const double most = static_cast<double>(mesh.num_facets()) + most_parts * num_samples(mesh, sizing, 1e9);
  if (!(most < 1e9)) return {};
  std::vector<SurfaceSample> on_split(samples.begin(), samples.end());
  SplitSurface split =
      split_long_edges(mesh, sizing, options.longest, on_split, static_cast<std::size_t>(most));
  if (static_cast<double>(split.mesh.num_facets()) > most) return {};
  std::vector<double> h(split.h.begin(), split.h.end());
  if (h.empty()) h.assign(split.mesh.num_vertices(), sizing.at(VertexId(0)));
  Table<VertexId, double> levels = SheetLevels(split.mesh, std::move(h), options).find();
  if (levels.empty()) return {};
  if (std::optional<FittedParts> fitted = fitted_parts(
          mesh, sizing, {split, levels}, {options.longest, options.largest, options.tolerance}, samples)) {
    split = std::move(fitted->surface);
    levels = std::move(fitted->values);
  } else {
    std::ranges::copy(on_split, samples.begin());
  }
  split.mesh = split.mesh.with_levels(std::move(levels));
  return split;
}

}  // namespace fpo
