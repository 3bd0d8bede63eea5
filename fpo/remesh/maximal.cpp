#include "fpo/remesh/maximal.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fpo/measure/covering.h"
#include "fpo/remesh/dual.h"
#include "geom/sites/site_tree.h"

namespace fpo {

using geom::SiteId;
using geom::Vec3;

namespace {

constexpr double least_share = 1e-9;  // of a squared distance: a gap is larger
constexpr int most_rounds = 1000;
constexpr double apart = 3;  // gaps that are filled at once, and samples that fill them, in units of h

/// Samples with their disks.
class DiskSet {
 public:
  DiskSet(const Sizing& sizing, std::vector<SurfaceSample>& samples) : sizing_(sizing), samples_(samples) {
    std::vector<Vec3> positions;
    positions.reserve(samples.size());
    for (const SurfaceSample& x : samples) positions.push_back(x.position);
    distances_ = nearest_distances(positions);
    const double least = *std::ranges::min_element(distances_);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double radius = sizing.is_uniform() ? least : distances_[i];
      disks_.push_back({positions[i], radius * radius});
    }
  }

  double spacing(std::size_t i) const { return distances_[i] / sizing_.at(samples_[i]); }

  /// The places that are in no disk, the deepest first: corners of the disks' power diagram.
  std::vector<Gap> gaps(const geom::TriMesh& mesh, int threads) const {
    double least = disks_.front().weight;
    for (const geom::WeightedPoint3& disk : disks_) least = std::min(least, disk.weight);
    std::vector<Gap> result = gaps_above(mesh, disks_, least_share * least, threads);
    std::ranges::stable_sort(result, std::greater(), [&](const Gap& gap) {
      const double h = sizing_.at(SurfaceSample{gap.place, gap.facet});
      return gap.power / (h * h);
    });
    return result;
  }

 private:
  const Sizing& sizing_;
  std::vector<SurfaceSample>& samples_;
  std::vector<double> distances_;
  std::vector<geom::WeightedPoint3> disks_;
};

/// Places that keep away from each other.
class Places {
 public:
  explicit Places(const Sizing& sizing) : sizing_(sizing) {}

  bool is_far(const SurfaceSample& x) const {
    const double distance = apart * sizing_.at(x);
    return size_ == 0 || tree_.nearest(x.position, SiteId()).radius2 > distance * distance;
  }
  void add(const SurfaceSample& x) { tree_.insert(SiteId(size_++), {x.position, 0}); }

 private:
  const Sizing& sizing_;
  geom::SiteTree tree_;
  std::size_t size_ = 0;
};

/// Fills gaps that are far from each other, each with the sample of the least spacing that is far from all
/// places touched. Returns the number of moves.
std::size_t fill(const std::vector<Gap>& gaps, const DiskSet& disks, const Sizing& sizing,
                 std::vector<SurfaceSample>& samples, std::size_t num_fixed) {
  std::vector<std::size_t> order(samples.size() - num_fixed);
  std::iota(order.begin(), order.end(), num_fixed);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return disks.spacing(i); });
  const std::vector<SurfaceSample> before = samples;
  geom::SiteTree tree;
  for (std::size_t i = 0; i < before.size(); ++i) tree.insert(SiteId(i), {before[i].position, 0});
  Places touched(sizing);
  std::size_t moves = 0;
  auto next = order.begin();
  for (const Gap& gap : gaps) {
    const SurfaceSample x{gap.place, gap.facet};
    if (!touched.is_far(x)) continue;
    while (next != order.end() && !touched.is_far(before[*next])) ++next;
    if (next == order.end()) break;
    const double gain = std::sqrt(tree.nearest(x.position, SiteId(*next)).radius2) / sizing.at(x);
    if (!(gain > disks.spacing(*next))) continue;
    touched.add(x), touched.add(before[*next]);
    samples[*next++] = x;
    ++moves;
  }
  return moves;
}

}  // namespace

MaximalResult make_maximal(const geom::TriMesh& mesh, const Sizing& sizing,
                           std::vector<SurfaceSample>& samples, const MaximalOptions& options) {
  MaximalResult result;
  if (samples.size() < 2) return result;
  while (result.rounds < most_rounds && !(options.interrupted && *options.interrupted)) {
    ++result.rounds;
    const DiskSet disks(sizing, samples);
    const std::vector<Gap> gaps = disks.gaps(mesh, options.threads);
    result.maximal = gaps.empty();
    const std::size_t moves = gaps.empty() ? 0 : fill(gaps, disks, sizing, samples, options.num_fixed);
    if (moves == 0) break;
    result.moves += moves;
  }
  return result;
}

MaximalResult make_maximal(SurfaceDomain& domain, const MaximalOptions& options) {
  std::vector<SurfaceSample> samples = samples_of(domain);
  const MaximalResult result = make_maximal(domain.mesh(), domain.sizing(), samples, options);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const geom::SiteId x(i);
    if (samples[i].position == domain.sample(x).position) continue;
    domain.remove(x);
    domain.insert_at(x, samples[i], 1);
  }
  return result;
}

}  // namespace fpo
