#include "fpo/baselines/descent.h"

#include <algorithm>

#include "fpo/baselines/first_samples.h"
#include "fpo/baselines/iterations.h"
#include "fpo/baselines/lbfgs.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using Eigen::VectorXd;
using geom::Vec3;

namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo's condition
constexpr int most_halvings = 8;
constexpr double largest_move = 0.5;  // of a sample in one step, in units of h

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(3 * i); }

/// Samples with their energy and its derivatives, 0 for those that are fixed.
struct State {
  std::vector<SurfaceSample> samples;
  EnergyAt e;
};

class Slope {
 public:
  Slope(const BaselineTask& task, const SampleEnergy& energy)
      : task_(task), energy_(energy), tree_(task.surface) {}

  State evaluated(std::vector<SurfaceSample> samples) const {
    State state;
    state.e = energy_(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i < task_.fixed.size())
        state.e.gradient.segment<3>(at(i)).setZero(), state.e.scale.segment<3>(at(i)).setZero();
      else
        state.e.gradient.segment<3>(at(i)) =
            along_surface(state.e.gradient.segment<3>(at(i)), samples[i].facet);
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
  Vec3 along_surface(const Vec3& v, geom::FacetId t) const {
    const Vec3 normal = task_.surface.normal(t);
    const double size2 = normal.squaredNorm();
    return size2 > 0 ? Vec3(v - v.dot(normal) / size2 * normal) : v;
  }

  const BaselineTask& task_;
  const SampleEnergy& energy_;
  geom::AabbTree tree_;
};

VectorXd difference(const std::vector<SurfaceSample>& to, const std::vector<SurfaceSample>& from) {
  VectorXd result(static_cast<Eigen::Index>(3 * to.size()));
  for (std::size_t i = 0; i < to.size(); ++i) result.segment<3>(at(i)) = to[i].position - from[i].position;
  return result;
}

/// Goes along the direction, half as far again and again until the energy sinks enough. False if it never
/// does.
bool go_along(const Slope& slope, State& state, const VectorXd& direction) {
  const double steepness = direction.dot(state.e.gradient);
  double t = 1;
  for (int halving = 0; halving <= most_halvings; ++halving, t /= 2) {
    State next = slope.evaluated(slope.moved(state.samples, t * direction));
    if (!(next.e.energy < state.e.energy + sufficient_decrease * t * std::min(steepness, 0.0))) continue;
    state = std::move(next);
    return true;
  }
  return false;
}

/// A plain step or one of L-BFGS; if the latter fails, a plain one. False if that fails too.
bool step(const Slope& slope, State& state, LbfgsMemory& memory, bool plain) {
  const State before = state;
  if (plain || !go_along(slope, state, memory.direction(state.e.gradient, state.e.scale))) {
    memory.clear();
    if (!go_along(slope, state, -state.e.gradient.cwiseProduct(state.e.scale))) return false;
  }
  memory.push(difference(state.samples, before.samples), state.e.gradient - before.e.gradient);
  return true;
}

}  // namespace

BaselineResult descend(const BaselineTask& task, const OptimizeOptions& options, const SampleEnergy& energy,
                       const DescentOptions& descent) {
  const Stopwatch watch;
  const Slope slope(task, energy);
  LbfgsMemory memory(descent.memory_size);
  State state = slope.evaluated(first_samples(task));
  IteratedMethod method;
  method.step = [&](int iteration) -> std::optional<std::size_t> {
    if (!step(slope, state, memory, iteration <= descent.plain_steps)) return std::nullopt;
    return task.num_inner();
  };
  method.samples = [&] { return std::span<const SurfaceSample>(state.samples); };
  BaselineResult result;
  result.run = iterate(task, options, method, watch);
  result.samples = std::move(state.samples);
  return result;
}

}  // namespace fpo
