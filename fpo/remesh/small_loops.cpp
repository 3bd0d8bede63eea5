#include "fpo/remesh/small_loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace fpo {

using geom::SiteId;
using geom::Vec3;

namespace {

constexpr double small = 0.6;

struct SmallLoop {
  double extra;  ///< samples that it costs
  std::vector<Spot> spots;
};

/// What a disk with h = low + gradation r takes beyond one with h = high, which it reaches in the end.
double extra_samples(double low, double high, double gradation) {
  const double g2 = gradation * gradation, ratio = high / low;
  const double graded = 2 / g2 * (std::log(ratio) + 1 / ratio - 1),
               even = (1 - 1 / ratio) * (1 - 1 / ratio) / g2;
  return std::numbers::pi / std::sqrt(0.75) * std::max(graded - even, 0.0);
}

using Chain = std::vector<SiteId>;

/// Closed chains, and pairs of chains that join the same two corners as one.
std::vector<Chain> closed_chains(const std::vector<Chain>& chains) {
  std::vector<Chain> closed;
  std::map<std::pair<SiteId, SiteId>, const Chain*> open;
  for (const Chain& chain : chains) {
    if (chain.size() < 2) continue;
    if (chain.front() == chain.back()) {
      closed.push_back(chain);
      continue;
    }
    const auto [at, is_first] = open.try_emplace(std::minmax(chain.front(), chain.back()), &chain);
    if (is_first) continue;
    Chain both = *at->second;
    if (chain.front() == both.back())
      both.insert(both.end(), chain.begin() + 1, chain.end());
    else
      both.insert(both.end(), chain.rbegin() + 1, chain.rend());
    closed.push_back(std::move(both));
  }
  return closed;
}

std::vector<SmallLoop> small_loops(const SharedSizing& shared, const SmallLoopOptions& options) {
  std::vector<SmallLoop> loops;
  const std::vector<SurfaceSample>& samples = shared.features.samples;
  for (const Chain& chain : closed_chains(shared.features.chains)) {
    if (chain.size() - 1 > options.most_edges) continue;
    double length = 0;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      length += (samples[chain[i].index()].position - samples[chain[i + 1].index()].position).norm();
    const double edge = length / static_cast<double>(chain.size() - 1);
    const double h = shared.sizing.at(samples[chain.front().index()]);
    if (!(edge > 0 && edge < small * h)) continue;
    SmallLoop loop{extra_samples(edge, h, options.gradation), {}};
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      loop.spots.push_back({samples[chain[i].index()].position, edge, options.gradation});
    loops.push_back(std::move(loop));
  }
  std::ranges::stable_sort(loops, {}, &SmallLoop::extra);
  return loops;
}

}  // namespace

SmallLoops make_room_for_small_loops(const geom::TriMesh& mesh, const SharedSizing& shared, std::size_t n,
                                     const SmallLoopOptions& options) {
  SmallLoops result{0, shared.sizing};
  const std::vector<SmallLoop> loops = small_loops(shared, options);
  if (loops.empty()) return result;
  result.loops = loops.size();
  const double most = static_cast<double>(n) * (1 - 1 / (options.most_scale * options.most_scale));
  std::vector<Spot> wanted;
  double extra = 0;
  for (const SmallLoop& loop : loops) {
    if (extra + loop.extra > most) break;
    extra += loop.extra;
    wanted.insert(wanted.end(), loop.spots.begin(), loop.spots.end());
  }
  auto spots = std::make_shared<Spots>();
  spots->add(wanted);
  if (spots->empty()) return result;
  const double scale = std::sqrt(static_cast<double>(n) / (static_cast<double>(n) - extra));
  result.sizing = shared.sizing.lowered(scale, spots, mesh);
  return result;
}

}  // namespace fpo
