#include "fpo/remesh/emptied_balls.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "fpo/interruption.h"
#include "fpo/remesh/proven_edges.h"
#include "fpo/remesh/remembered_samples.h"
#include "fpo/remesh/sent_away.h"

namespace fpo {

using geom::SiteId;

namespace {

constexpr int rounds = 10;
constexpr double most_share = 1.5;     // of the usual weight
constexpr double more = 1.02;          // than what is lacking, which is rounded
constexpr std::size_t most_sent = 48;  // of samples that leave, one after the other

void change_weight(SurfaceDomain& domain, SiteId x, double share) {
  const SurfaceSample place = domain.sample(x);
  domain.remove(x);
  domain.insert_at(x, place, share);
}

/// How much weight each end needs.
std::map<SiteId, double> lacking(const std::vector<OpenBall>& open) {
  std::map<SiteId, double> lack;
  for (const OpenBall& ball : open)
    for (const SiteId x : {ball.a, ball.b}) lack[x] = std::max(lack[x], ball.lack);
  return lack;
}

}  // namespace

std::size_t empty_balls(SurfaceDomain& domain, const Features& features, const FeatureSamples& samples) {
  std::vector<OpenBall> open = open_balls(domain, features, samples);
  std::map<SiteId, double> before;  // shares of weights
  for (int round = 0; round < rounds && !open.empty(); ++round) {
    std::vector<std::pair<SiteId, double>> changed;
    for (const auto& [x, lack] : lacking(open)) {
      const double share = domain.weight_share(x),
                   raised = share + more * lack / domain.samples().full_weight(x);
      if (!(raised > share) || !(raised <= most_share)) continue;
      before.emplace(x, share);
      changed.emplace_back(x, share);
      change_weight(domain, x, raised);
    }
    if (changed.empty()) break;
    std::vector<OpenBall> now = open_balls(domain, features, samples);
    if (now.size() >= open.size()) {
      for (const auto& [x, share] : changed) change_weight(domain, x, share);
      break;
    }
    open = std::move(now);
  }
  return static_cast<std::size_t>(std::ranges::count_if(
      before, [&](const auto& entry) { return domain.weight_share(entry.first) != entry.second; }));
}

std::size_t send_out_of_balls(SurfaceDomain& domain, const Features& features, const FeatureSamples& samples,
                              const std::atomic<bool>* interrupted) {
  std::size_t sent = 0;
  std::vector<OpenBall> open = open_balls(domain, features, samples);
  std::set<SiteId> tried;
  const auto may_leave = [&](const OpenBall& ball) {
    return ball.deepest.valid() && !domain.is_fixed(ball.deepest) && !tried.contains(ball.deepest);
  };
  while (tried.size() < most_sent && !fpo::interrupted(interrupted)) {
    const auto ball = std::ranges::find_if(open, may_leave);
    if (ball == open.end()) break;
    tried.insert(ball->deepest);
    const RememberedSamples before(domain);
    send_to_farthest(domain, ball->deepest);
    std::vector<OpenBall> now = open_balls(domain, features, samples);
    if (now.size() < open.size()) {
      open = std::move(now);
      ++sent;
    } else {
      before.put_back(domain);
    }
  }
  return sent;
}

}  // namespace fpo
