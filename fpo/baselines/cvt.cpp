#include "fpo/baselines/cvt.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fpo/baselines/cell_moments.h"
#include "fpo/baselines/disks.h"
#include "fpo/baselines/lbfgs.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using Eigen::VectorXd;
using geom::Vec3;

namespace {

constexpr int lloyd_steps = 5;
constexpr std::size_t memory_size = 7;
constexpr double sufficient_decrease = 1e-4;  // Armijo's condition
constexpr int most_halvings = 8;
constexpr double room_of_fixed = 0.7;  // their cells reach half of h to both sides of a crease
constexpr std::size_t draws_per_sample = 3;
constexpr double largest_move = 0.5;  // of a sample in one step, in units of h

/// Those that are fixed, then random ones, not too near to them as far as there is room: a sample that starts
/// between two neighbours on a crease never gets out from between them.
std::vector<SurfaceSample> first_samples(const BaselineTask& task) {
  Disks samples(task.sizing, room_of_fixed);
  for (const SurfaceSample& x : task.fixed) samples.add(x);
  std::vector<SurfaceSample> result = samples.samples(), crowded;
  if (task.num_inner() == 0) return result;
  const std::size_t draws =
      task.fixed.empty()
          ? task.num_inner()
          : std::max(task.num_inner(), std::min(max_samples, draws_per_sample * task.num_inner()));
  for (const SurfaceSample& x : random_samples(task.surface, task.sizing, draws, task.seed))
    (samples.is_free(x.position) ? result : crowded).push_back(x);
  if (result.size() < task.num_samples) result.insert(result.end(), crowded.begin(), crowded.end());
  result.resize(task.num_samples);
  return result;
}

/// Samples with their energy and its derivatives.
struct State {
  std::vector<SurfaceSample> samples;
  double energy = 0;
  VectorXd gradient;  ///< along the surface, 0 for samples that are fixed
  VectorXd scale;     ///< 1 / (2 m_i)
};

class Tessellation {
 public:
  explicit Tessellation(const BaselineTask& task)
      : task_(task),
        tree_(task.surface),
        moments_(task.surface, task.sizing, hexagonal_spacing(task.surface.area(), task.num_samples),
                 task.threads) {}

  State evaluated(std::vector<SurfaceSample> samples) {
    State state;
    const geom::Table<SiteId, CellMoments>& moments = moments_.of(samples);
    const auto size = static_cast<Eigen::Index>(3 * samples.size());
    state.gradient = VectorXd::Zero(size);
    state.scale = VectorXd::Zero(size);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const CellMoments& cell = moments[SiteId(i)];
      state.energy += cell.second;
      if (i < task_.fixed.size() || !(cell.mass > 0)) continue;
      state.gradient.segment<3>(at(i)) = along_surface(-2 * cell.first, samples[i].facet);
      state.scale.segment<3>(at(i)).setConstant(1 / (2 * cell.mass));
    }
    state.samples = std::move(samples);
    return state;
  }

  /// The samples displaced and put back on the surface. A part of their displacement is cut off where it is
  /// too long.
  std::vector<SurfaceSample> moved(const std::vector<SurfaceSample>& samples, const VectorXd& by) const {
    std::vector<SurfaceSample> result = samples;
    for (std::size_t i = task_.fixed.size(); i < samples.size(); ++i) {
      Vec3 step = by.segment<3>(at(i));
      const double length = step.norm(), most = largest_move * task_.sizing.at(samples[i]);
      if (length == 0) continue;
      if (length > most) step *= most / length;
      const geom::AabbTree::Closest closest = tree_.closest(samples[i].position + step, samples[i].facet);
      result[i] = {geom::snapped(closest.point), closest.facet};
    }
    return result;
  }

 private:
  static Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(3 * i); }

  Vec3 along_surface(const Vec3& v, geom::FacetId t) const {
    const Vec3 normal = task_.surface.normal(t);
    const double size2 = normal.squaredNorm();
    return size2 > 0 ? Vec3(v - v.dot(normal) / size2 * normal) : v;
  }

  const BaselineTask& task_;
  geom::AabbTree tree_;
  VoronoiMoments moments_;
};

VectorXd difference(const std::vector<SurfaceSample>& to, const std::vector<SurfaceSample>& from) {
  VectorXd result(static_cast<Eigen::Index>(3 * to.size()));
  for (std::size_t i = 0; i < to.size(); ++i)
    result.segment<3>(static_cast<Eigen::Index>(3 * i)) = to[i].position - from[i].position;
  return result;
}

/// Goes along the direction, half as far again and again until the energy sinks enough. False if it never
/// does.
bool descend(Tessellation& tessellation, State& state, const VectorXd& direction) {
  const double slope = direction.dot(state.gradient);
  double t = 1;
  for (int halving = 0; halving <= most_halvings; ++halving, t /= 2) {
    State next = tessellation.evaluated(tessellation.moved(state.samples, t * direction));
    if (!(next.energy < state.energy + sufficient_decrease * t * std::min(slope, 0.0))) continue;
    state = std::move(next);
    return true;
  }
  return false;
}

/// One step of Lloyd's or of L-BFGS; if the latter fails, one of Lloyd's. False if that fails too.
bool step(Tessellation& tessellation, State& state, LbfgsMemory& memory, bool by_lloyd) {
  const State before = state;
  if (by_lloyd || !descend(tessellation, state, memory.direction(state.gradient, state.scale))) {
    memory.clear();
    if (!descend(tessellation, state, -state.gradient.cwiseProduct(state.scale))) return false;
  }
  memory.push(difference(state.samples, before.samples), state.gradient - before.gradient);
  return true;
}

}  // namespace

BaselineResult centroidal_tessellation(const BaselineTask& task, const OptimizeOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Tessellation tessellation(task);
  LbfgsMemory memory(memory_size);
  State state = tessellation.evaluated(first_samples(task));
  BaselineResult result;
  const auto report = [&](int iteration, std::size_t moved) {
    result.run.last = measure(task, state.samples);
    result.run.last.iteration = iteration;
    result.run.last.moved = moved;
    result.run.last.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.run.moves += moved;
    if (options.on_iteration) options.on_iteration(result.run.last);
  };
  report(0, 0);
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    if (interrupted(options)) {
      result.run.reason = StopReason::interrupted;
      break;
    }
    if (options.on_move) options.on_move(static_cast<std::size_t>(iteration - 1) * task.num_samples);
    if (!step(tessellation, state, memory, iteration <= lloyd_steps)) {
      result.run.reason = StopReason::nothing_moved;
      break;
    }
    report(iteration, task.num_inner());
  }
  result.samples = std::move(state.samples);
  return result;
}

}  // namespace fpo
