#include "fpo/remesh/protect.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "fpo/farthest_move.h"
#include "fpo/interruption.h"

namespace fpo {

using geom::SiteId;
using geom::Vec3;

namespace {

constexpr int rounds = 10;
constexpr int futile_rounds = 2;   // in a row, with no edge less to miss
constexpr double most_share = 8;   // of the usual weight: larger disks would swallow all around them
constexpr double crowded = 0.5;    // wanted lengths to the next sample of the features
constexpr double least_own = 0.5;  // of a squared distance: a larger difference of weights hides a sample

using Edge = std::pair<SiteId, SiteId>;

/// Those of the chains that the RRT lacks.
std::vector<Edge> missing_edges(const SurfaceDomain& domain, const FeatureSamples& features) {
  std::vector<Edge> missing;
  std::vector<SiteId> link;
  for (const std::vector<SiteId>& chain : features.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      domain.dual().link(chain[i], link);
      if (std::ranges::find(link, chain[i + 1]) == link.end()) missing.emplace_back(chain[i], chain[i + 1]);
    }
  return missing;
}

/// Distances from the samples of the features to the nearest others, in what makes a crowd: at most 1.
std::vector<double> room_at(const SurfaceDomain& domain, const FeatureSamples& features) {
  const std::size_t count = features.samples.size();
  std::vector<double> room;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& x = domain.sample(SiteId(i)).position;
    const double enough = crowded * domain.sizing().at(domain.sample(SiteId(i)));
    double nearest2 = enough * enough;
    for (std::size_t j = 0; j < count; ++j)
      if (i != j) nearest2 = std::min(nearest2, (domain.sample(SiteId(j)).position - x).squaredNorm());
    room.push_back(std::sqrt(nearest2) / enough);
  }
  return room;
}

bool change_weight(SurfaceDomain& domain, SiteId x, double share) {
  const SurfaceSample place = domain.sample(x);
  domain.remove(x);
  domain.insert_at(x, place, share);
  return true;
}

/// Where samples are much closer than wanted, weights that are due to wanted lengths differ by more than the
/// squares of distances: the weights are made those of the distances.
std::size_t lower_weights(SurfaceDomain& domain, const std::vector<double>& room) {
  std::size_t lowered = 0;
  for (std::size_t i = 0; i < room.size(); ++i) {
    const SiteId x(i);
    const double share = room[i] * room[i];
    if (domain.dual().site(x).weight > 0 && share < domain.weight_share(x))
      lowered += change_weight(domain, x, share);
  }
  return lowered;
}

/// Weights raised in one round, with what they were.
using Raised = std::vector<std::pair<SiteId, double>>;

/// So that its disk reaches the middle of an edge of this length. False if it does already or never may.
bool raise_weight(SurfaceDomain& domain, SiteId x, double length2, Raised& raised) {
  const double share = 1 + length2 / 4 / domain.samples().full_weight(x);
  if (!(share > domain.weight_share(x)) || share > most_share) return false;
  raised.emplace_back(x, domain.weight_share(x));
  return change_weight(domain, x, share);
}

/// Does each other sample of the features own its own place, and some more, for all that x can?
bool leaves_others(const SurfaceDomain& domain, std::size_t num_features, SiteId x) {
  const geom::WeightedPoint3& site = domain.dual().site(x);
  for (SiteId y(0); y.index() < num_features; y = SiteId(y.value + 1)) {
    const geom::WeightedPoint3& other = domain.dual().site(y);
    const double distance2 = (other.position - site.position).squaredNorm();
    if (y != x && site.weight - other.weight > least_own * distance2) return false;
  }
  return true;
}

/// Takes back what does not leave others their places, when all are raised. Who that was is not raised again.
void take_back(SurfaceDomain& domain, std::size_t num_features, Raised& raised, std::set<SiteId>& not_again) {
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& [x, share] : raised) {
      if (!(share < domain.weight_share(x)) || leaves_others(domain, num_features, x)) continue;
      changed = change_weight(domain, x, share);
      not_again.insert(x);
    }
  }
}

bool move_away_from(SurfaceDomain& domain, const geom::Location3& middle) {
  const SiteId x = domain.dual().nearest(middle, SiteId()).site;
  return !domain.is_fixed(x) && move_to_farthest(domain, x);
}

}  // namespace

Protection protect_chains(SurfaceDomain& domain, const FeatureSamples& features,
                          const std::atomic<bool>* interrupted) {
  Protection result;
  std::vector<Edge> missing = missing_edges(domain, features);
  if (missing.empty()) return result;
  const std::vector<double> room = room_at(domain, features);
  if (lower_weights(domain, room) > 0) missing = missing_edges(domain, features);
  std::set<SiteId> weighted, not_again;
  std::size_t fewest = missing.size();
  int futile = 0;
  for (int round = 0; round < rounds && futile < futile_rounds && !missing.empty(); ++round) {
    bool changed = false;
    Raised all_raised;
    for (const auto& [a, b] : missing) {
      if (fpo::interrupted(interrupted)) break;
      const Vec3 from = domain.sample(a).position, to = domain.sample(b).position;
      bool raised = false;
      if (room[a.index()] == 1 && room[b.index()] == 1)
        for (const SiteId x : {a, b})
          if (!not_again.contains(x) && raise_weight(domain, x, (to - from).squaredNorm(), all_raised)) {
            weighted.insert(x);
            raised = true;
          }
      const Vec3 middle = (from + to) / 2;
      const double level = (domain.dual().site(a).level + domain.dual().site(b).level) / 2;
      const bool moved = !raised && move_away_from(domain, {middle, level});
      result.moved += moved;
      changed |= raised || moved;
    }
    take_back(domain, room.size(), all_raised, not_again);
    if (!changed || fpo::interrupted(interrupted)) break;
    missing = missing_edges(domain, features);
    futile = missing.size() < fewest ? 0 : futile + 1;
    fewest = std::min(fewest, missing.size());
  }
  std::erase_if(weighted, [&](SiteId x) { return !(domain.weight_share(x) > 1); });
  result.weighted = weighted.size();
  return result;
}

}  // namespace fpo
