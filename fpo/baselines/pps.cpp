#include "fpo/baselines/pps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "fpo/baselines/disks.h"
#include "geom/parallel.h"
#include "geom/rng.h"

namespace fpo {

using geom::Vec3;

namespace {

constexpr std::size_t candidates_per_sample = 200;  // with fewer, gaps between them show in the angles
constexpr std::size_t least_shared = 256;           // fewer darts are thrown before a thread has begun

/// The candidates of a cube, by their places in the cloud, in its random order: [next, last) of a list.
struct Cube {
  std::size_t next, last;
};

/// The cubes of one level and phase in which there can be another sample.
struct PhaseGroup {
  std::vector<Cube> cubes;
};

/// Where a candidate belongs. Sorted, the candidates of a cube follow each other, as do the cubes of a group.
struct Slot {
  int level;
  int phase;
  std::array<std::int64_t, 3> cube;
  std::size_t candidate;
  auto cube_key() const { return std::tie(level, phase, cube); }
  auto operator<=>(const Slot&) const = default;
};

class PhaseGroups {
 public:
  PhaseGroups(const BaselineTask& task, const std::vector<SurfaceSample>& cloud, double radius_factor)
      : cloud_(cloud) {
    const std::vector<Slot> slots = sorted_slots(task, radius_factor);
    for (std::size_t first = 0, last; first < slots.size(); first = last) {
      last = first;
      while (last < slots.size() && slots[last].cube_key() == slots[first].cube_key()) ++last;
      const bool same_group = first > 0 && slots[first - 1].level == slots[first].level &&
                              slots[first - 1].phase == slots[first].phase;
      if (!same_group) groups_.emplace_back();
      groups_.back().cubes.push_back({first, last});
    }
    for (const Slot& slot : slots) order_.push_back(slot.candidate);
  }

  /// Throws a dart in each cube of each group. False if there was none left.
  bool trial(Disks& disks, geom::Rng& rng, int threads) {
    std::vector<std::size_t> sequence;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!groups_[g].cubes.empty()) sequence.push_back(g);
    rng.shuffle(std::span(sequence));
    for (const std::size_t g : sequence) run(groups_[g], disks, threads);
    return !sequence.empty();
  }

 private:
  const SurfaceSample& put_forward(const Cube& cube) const { return cloud_[order_[cube.next]]; }

  /// One phase. The disks stay as they are while candidates are tested.
  void run(PhaseGroup& group, Disks& disks, int threads) {
    accepted_.assign(group.cubes.size(), 0);
    geom::parallel_ranges(group.cubes.size(), least_shared, threads,
                          [&](std::size_t first, std::size_t last) {
                            for (std::size_t i = first; i < last; ++i)
                              accepted_[i] = disks.is_free(put_forward(group.cubes[i]).position);
                          });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < group.cubes.size(); ++i) {
      Cube cube = group.cubes[i];
      if (accepted_[i]) disks.add(put_forward(cube));
      if (!accepted_[i] && ++cube.next < cube.last) group.cubes[kept++] = cube;
    }
    group.cubes.resize(kept);
  }

  std::vector<Slot> sorted_slots(const BaselineTask& task, double radius_factor) const {
    std::vector<double> radii;
    for (const SurfaceSample& x : cloud_) radii.push_back(radius_factor * task.sizing.at(x));
    const double least = radii.empty() ? 0 : *std::ranges::min_element(radii);
    const int phases = task.sizing.is_uniform() ? 3 : 5;
    std::vector<Slot> slots;
    slots.reserve(cloud_.size());
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      const int level = static_cast<int>(std::floor(std::log2(radii[i] / least)));
      const double side = std::ldexp(least, level) / std::numbers::sqrt3;
      const Vec3 offset = (cloud_[i].position - task.surface.box().min()) / side;
      Slot slot{level, 0, {}, i};
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::int64_t>(std::floor(offset[axis]));
        slot.cube[static_cast<std::size_t>(axis)] = at;
        slot.phase = slot.phase * phases + static_cast<int>(at % phases);
      }
      slots.push_back(slot);
    }
    std::ranges::sort(slots);
    return slots;
  }

  const std::vector<SurfaceSample>& cloud_;
  std::vector<std::size_t> order_;  ///< of the candidates
  std::vector<PhaseGroup> groups_;
  std::vector<char> accepted_;  // workspace
};

}  // namespace

BaselineResult parallel_poisson_disks(const BaselineTask& task, const OptimizeOptions& options) {
  const std::vector<SurfaceSample> cloud = random_pool(task, candidates_per_sample);
  BaselineResult result = search_radius(task, options, [&](double radius_factor) {
    Disks disks(task.sizing, radius_factor);
    for (const SurfaceSample& x : task.fixed) disks.add(x);
    PhaseGroups groups(task, cloud, radius_factor);
    geom::Rng rng(task.seed + 1);  // not that of the cloud
    while (!interrupted(options) && groups.trial(disks, rng, task.threads)) {
    }
    return disks.samples();
  });
  result.reached.push_back({"candidates", static_cast<double>(cloud.size())});
  return result;
}

}  // namespace fpo
