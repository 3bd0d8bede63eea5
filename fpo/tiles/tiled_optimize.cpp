#include "fpo/tiles/tiled_optimize.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "fpo/interruption.h"
#include "fpo/stopwatch.h"
#include "fpo/surface/spacings.h"
#include "fpo/surface/split_facets.h"
#include "fpo/tiles/known_cells.h"
#include "fpo/tiles/tile_domain.h"
#include "geom/check.h"
#include "geom/parallel.h"
#include "geom/rng.h"

namespace fpo {
namespace {

constexpr double longest_edge = 4;       // in spacings: a tile is some fifty wide
constexpr std::size_t most_parts = 100;  // of facets, a sample: needles stay long
constexpr double near_cut = 4;           // in spacings: nearer to a cut many samples cannot be moved
constexpr int iterations_at_large = 3;   // before there are tiles
constexpr int sweeps_gained = 2;         // by each round on the one before, while they are few

/// The samples on the surface, or while there are tiles on one without large facets.
class TiledSamples {
 public:
  TiledSamples(const SurfaceTask& task, std::vector<SurfaceSample> samples)
      : task_(task), samples_(std::move(samples)), sizing_(task.sizing) {}

  /// On mesh().
  std::vector<SurfaceSample>& all() { return samples_; }
  std::size_t size() const { return samples_.size(); }
  const SurfaceSample& operator[](std::size_t i) const { return samples_[i]; }
  const geom::TriMesh& mesh() const { return split_ ? split_->mesh : task_.mesh; }
  const Sizing& sizing() const { return sizing_; }
  IterationReport measured(int threads) const {
    return measure_positions(samples_, sizing_, task_.surface.num_fixed, threads);
  }
  /// Of what was given, with what is known of the cells there. Takes all().
  SurfaceDomain domain(std::optional<KnownCells> known = {});

  bool needs_split() const { return has_long_edges(task_.mesh, task_.sizing, longest_edge); }
  bool is_split() const { return split_.has_value(); }
  void split();    ///< from now on mesh() has no large facets, unless these are needles by the thousand
  void unsplit();  ///< from now on it is what was given

 private:
  const SurfaceTask& task_;
  std::vector<SurfaceSample> samples_;
  std::optional<SplitSurface> split_;  ///< if there are large facets
  Sizing sizing_;                      ///< on mesh()
};

SurfaceDomain TiledSamples::domain(std::optional<KnownCells> known) {
  SurfaceOptions options = task_.surface;
  WeightedSamples all(task_.sizing, std::exchange(samples_, {}), options);
  std::vector<geom::KnownCell> cells;
  if (known) {
    cells = known->of_all(all);
    known->forget_cells();  // they are as large as these
    options.known = {cells, known->circles(), known->reaches(), known->power()};
  }
  return SurfaceDomain(task_.mesh, std::move(all), options);
}

void TiledSamples::split() {
  if (!needs_split()) return;
  const std::size_t most = task_.mesh.num_facets() + most_parts * samples_.size();
  split_ = split_long_edges(task_.mesh, task_.sizing, longest_edge, samples_, most);
  if (!sizing_.is_uniform()) sizing_ = Sizing(split_->mesh, split_->h);
}

void TiledSamples::unsplit() {
  if (!split_) return;
  for (SurfaceSample& x : samples_) x.facet = split_->parents[x.facet];
  sizing_ = task_.sizing;
  split_.reset();
}

class TiledRun {
 public:
  TiledRun(SurfaceTask& task, const TileOptions& tiles, const OptimizeOptions& options,
           OptimizeResult& result)
      : task_(task),
        tile_options_(tiles),
        options_(options),
        result_(result),
        samples_(task, std::move(task.samples)),
        owed_(samples_.size(), 0),
        rng_(options.seed) {}

  SurfaceDomain take();

 private:
  StopReason rounds();
  bool round();
  struct RoundEnd {  ///< each tile writes what is its own
    std::vector<SurfaceSample> samples;
    KnownCells known;
  };
  void work_on(const TiledSurface& whole, std::size_t tile, std::uint64_t seed, RoundEnd& end);
  void catch_up(SurfaceDomain& domain);
  void report(IterationReport report);

  bool interrupted() const { return fpo::interrupted(options_.interrupted); }
  bool is_fixed(SiteId x) const { return x.index() < task_.surface.num_fixed; }
  void announce_move();
  bool begin_at_large(SurfaceDomain& domain);
  std::vector<CutCost> cut_costs() const;
  void owe(int moves);

  const SurfaceTask& task_;
  const TileOptions& tile_options_;
  const OptimizeOptions& options_;
  OptimizeResult& result_;
  TiledSamples samples_;   ///< to the end of the last round
  std::vector<int> owed_;  ///< moves that each sample is behind
  geom::Rng rng_;
  int iteration_ = 0, round_ = 0, sweeps_ = 0;
  std::size_t moved_ = 0;            ///< in the round
  std::optional<KnownCells> known_;  ///< of the cells at the end of the last round
  std::mutex access_;                ///< to the callbacks, the result and moved_
  Stopwatch watch_;
};

void TiledRun::announce_move() {
  const std::lock_guard lock(access_);
  if (options_.on_move) options_.on_move(result_.moves);
  ++result_.moves;
}

void TiledRun::report(IterationReport report) {
  report.iteration = iteration_;
  report.moved = moved_;
  report.seconds = watch_.seconds();
  result_.last = report;
  if (options_.on_iteration) options_.on_iteration(report);
}

/// All that is owed to the samples of a tile, spread evenly over the sweeps. Those that turn out to be too
/// near to a cut are tried again after 1, 2, 4, ... sweeps. Those that rest count as moved.
void TiledRun::work_on(const TiledSurface& whole, std::size_t tile, std::uint64_t seed, RoundEnd& end) {
  std::vector<SiteId> order;
  for (const SiteId x : whole.tiles()[tile].samples)
    if (!is_fixed(x)) order.push_back(x);
  if (order.empty() || interrupted()) {
    const std::lock_guard lock(access_);
    return end.known.raise_power(std::numeric_limits<double>::infinity());  // it is not looked at
  }
  TileDomain domain(whole, tile);
  geom::Rng rng(seed + tile);
  std::vector<int> done(order.size(), 0), next_try(order.size(), 1), index(order.size());
  std::iota(index.begin(), index.end(), 0);
  std::size_t moved = 0, moves = 0;
  for (int sweep = 1; sweep <= sweeps_; ++sweep) {
    if (options_.order != VisitOrder::in_turn) rng.shuffle(std::span(index));
    const std::vector<SiteId> awake = domain.restless(order, options_.rest_spacing);  // ascending
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (k + look_ahead < index.size())
        domain.expect(order[static_cast<std::size_t>(index[k + look_ahead])]);
      const int i = index[k];
      const SiteId x = order[static_cast<std::size_t>(i)];
      int& times = done[static_cast<std::size_t>(i)];
      if (sweep < next_try[static_cast<std::size_t>(i)]) continue;
      const int due = owed_[x.index()] * sweep / sweeps_;
      if (!std::ranges::binary_search(awake, x)) times = due;
      for (; times < due; ++times) {
        if (interrupted()) break;
        try {
          const MoveOutcome outcome = domain.move(x, options_.scope);
          if (outcome == MoveOutcome::forbidden) {
            next_try[static_cast<std::size_t>(i)] = 2 * sweep;
            break;
          }
          moved += outcome == MoveOutcome::moved;
        } catch (const geom::Bug& bug) {
          throw geom::Bug("tile " + std::to_string(tile) + ", move " + std::to_string(moves) + ": " +
                          bug.what());
        }
        ++moves;
        announce_move();
      }
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    end.samples[order[i].index()] = domain.sample(order[i]);
    owed_[order[i].index()] -= done[i];
  }
  domain.tell(end.known);
  const std::lock_guard lock(access_);
  end.known.raise_power(domain.largest_reach());
  moved_ += moved;
}

/// False if it was interrupted.
bool TiledRun::round() {
  moved_ = 0;
  ++round_;
  sweeps_ = std::min({sweeps_gained * round_, tile_options_.sweeps, options_.max_iterations - iteration_});
  const std::vector<CutCost> costs = cut_costs();
  owe(sweeps_);
  std::vector<Tile> tiles =
      make_tiles(samples_.mesh(), samples_.all(), {tile_options_.most_samples, rng_.bits(), costs});
  // Large ones first, so that threads end at about the same time.
  std::ranges::stable_sort(tiles, std::greater(), [](const Tile& tile) { return tile.samples.size(); });
  TiledSurface whole(samples_.mesh(), samples_.sizing(), samples_.all(), task_.surface, std::move(tiles));
  if (known_) whole.set_known(*known_);
  RoundEnd end{samples_.all(), KnownCells(samples_.size(), whole.tiles().size())};
  const std::uint64_t seed = rng_.bits();
  try {
    geom::parallel_ranges(whole.tiles().size(), 1, tile_options_.threads,
                          [&](std::size_t tile, std::size_t) { work_on(whole, tile, seed, end); });
  } catch (const geom::Bug& bug) {
    throw geom::Bug("after iteration " + std::to_string(iteration_) + ", " + bug.what());
  }
  samples_.all() = std::move(end.samples);
  end.known.end_round();
  known_ = std::move(end.known);
  iteration_ += sweeps_;
  return !interrupted();
}

/// Who has waited long should not wait again.
std::vector<CutCost> TiledRun::cut_costs() const {
  std::vector<CutCost> costs;
  costs.reserve(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i)
    costs.push_back({static_cast<double>(owed_[i]) * owed_[i], near_cut * samples_.sizing().at(samples_[i])});
  return costs;
}

void TiledRun::owe(int moves) {
  for (std::size_t i = task_.surface.num_fixed; i < samples_.size(); ++i) owed_[i] += moves;
}

/// Gives the samples what they are still owed.
void TiledRun::catch_up(SurfaceDomain& domain) {
  for (int sweep = 0; sweep < *std::ranges::max_element(owed_); ++sweep)
    for (std::size_t i = 0; i < owed_.size() && !interrupted(); ++i) {
      if (owed_[i] <= sweep) continue;
      if (i + look_ahead < owed_.size()) domain.expect(SiteId(i + look_ahead));
      announce_move();
      try {
        moved_ += domain.move(SiteId(i), options_.scope);
      } catch (const geom::Bug& bug) {
        throw geom::Bug("on the whole surface, sample " + std::to_string(i) + ": " + bug.what());
      }
    }
}

/// The first iterations, on the whole surface. They even out the density of the samples at large, which tiles
/// would do slowly: without them delta ends lower. False if that was all.
bool TiledRun::begin_at_large(SurfaceDomain& domain) {
  OptimizeOptions first = options_;
  first.max_iterations = std::min(iterations_at_large, options_.max_iterations);
  first.on_iteration = [&](const IterationReport& now) {
    iteration_ = now.iteration;
    moved_ = now.moved;
    report(now);
  };
  const OptimizeResult done = optimize(domain, first);
  result_.moves = done.moves;
  result_.reason = done.reason;
  samples_.all().reserve(domain.num_samples());
  for (std::size_t i = 0; i < domain.num_samples(); ++i) samples_.all().push_back(domain.sample(SiteId(i)));
  return done.reason == StopReason::iteration_cap && iteration_ < options_.max_iterations;
}

/// Rounds until there is a reason to stop.
StopReason TiledRun::rounds() {
  while (iteration_ < options_.max_iterations) {
    if (!round()) return StopReason::interrupted;
    if (moved_ == 0 && std::ranges::count(owed_, 0) == std::ssize(owed_)) return StopReason::nothing_moved;
    if (iteration_ == options_.max_iterations) break;
    const IterationReport now = samples_.measured(tile_options_.threads);
    if (now.delta > options_.target_delta) return StopReason::target_reached;
    report(now);
  }
  return StopReason::iteration_cap;
}

SurfaceDomain TiledRun::take() {
  geom::require(samples_.size() > 0, "there must be at least one sample");
  if (options_.scope == Scope::global && options_.max_iterations > 0) {
    std::optional<SurfaceDomain> whole = samples_.domain();
    const bool is_begun = begin_at_large(*whole);
    if (!is_begun && interrupted()) return std::move(*whole);
    if (!is_begun) {
      whole.reset();  // two of them would be the most memory of the run
      return samples_.domain();
    }
    if (!samples_.needs_split()) known_.emplace(whole->dual());  // else facets are going to be others
  } else {
    report(samples_.measured(tile_options_.threads));
  }
  samples_.split();
  result_.reason = rounds();
  if (samples_.is_split() || result_.reason == StopReason::interrupted) known_.reset();
  samples_.unsplit();
  SurfaceDomain domain = samples_.domain(std::exchange(known_, {}));
  if (iteration_ == 0) return domain;
  if (result_.reason == StopReason::iteration_cap) catch_up(domain);
  report(measure(domain));
  if (interrupted())
    result_.reason = StopReason::interrupted;
  else if (result_.last.delta > options_.target_delta)
    result_.reason = StopReason::target_reached;
  return domain;
}

}  // namespace

SurfaceDomain optimize_in_tiles(SurfaceTask task, const TileOptions& tiles, const OptimizeOptions& options,
                                OptimizeResult& result) {
  return TiledRun(task, tiles, options, result).take();
}

}  // namespace fpo
