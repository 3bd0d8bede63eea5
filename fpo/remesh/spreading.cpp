#include "fpo/remesh/spreading.h"

#include <algorithm>
#include <array>

#include "fpo/remesh/nearby_places.h"

namespace fpo {

namespace {

constexpr std::array<double, 5> steps = {0.005, 0.01, 0.02, 0.04, 0.08};  // in units of h
constexpr int directions_of_steps = 12;
constexpr int most_spreading_rounds = 8;
constexpr double least_spread = 0.02;  // of a triangle's penalty
constexpr double drift_of_lengths = 1e-12;
constexpr std::size_t most_trials = 12;  // of the places that would be best

/// What an edge from a sample lacks, squared.
double lack2(const SurfaceDomain& domain, double delta, const SurfaceSample& a, const geom::Vec3& b) {
  const double lack = 1 - (a.position - b).norm() / (delta * domain.sizing().at(a));
  return lack > drift_of_lengths ? lack * lack : 0;
}

FlawMeasure short_edges(const SurfaceDomain& domain, double delta) {
  return [&domain, delta](const geom::EmptyCircle& circle, double) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += lack2(domain, delta, domain.sample(circle.sites[i]),
                   domain.sample(circle.sites[(i + 1) % 3]).position);
    return sum;
  };
}

std::vector<Flaws*> with_first(Flaws& first, std::vector<Flaws*> others) {
  others.insert(others.begin(), &first);
  return others;
}

}  // namespace

Spreading::Spreading(SurfaceDomain& domain, std::vector<Flaws*> others, const geom::AabbTree& tree,
                     const Goal& goal)
    : domain_(domain),
      tree_(tree),
      goal_(goal),
      close_(domain, short_edges(domain, goal.delta)),
      resampling_(domain, with_first(close_, std::move(others)), goal.at_worst) {}

double Spreading::lack(SiteId x, const SurfaceSample& place) const {
  double sum = 0;
  domain_.dual().link(x, link_);
  for (const SiteId y : link_) sum += lack2(domain_, goal_.delta, place, domain_.sample(y).position);
  return sum;
}

std::vector<Trial> Spreading::trials(const std::array<SiteId, 3>& corners) const {
  struct Estimate {
    double lack;
    Trial trial;
  };
  std::vector<Estimate> estimates;
  for (const SiteId x : corners) {
    if (domain_.is_fixed(x)) continue;
    const SurfaceSample home = domain_.sample(x);
    const double now = lack(x, home);
    for (const SurfaceSample& place :
         nearby_places(domain_.mesh(), tree_, home, {domain_.sizing().at(home), steps, directions_of_steps}))
      if (const double change = lack(x, place) - now; change < 0) estimates.push_back({change, {x, place}});
  }
  std::ranges::stable_sort(estimates, {}, &Estimate::lack);
  std::vector<Trial> best;
  for (std::size_t i = 0; i < std::min(most_trials, estimates.size()); ++i)
    best.push_back(estimates[i].trial);
  return best;
}

bool Spreading::spread() {
  const auto cost = [&](double limit) { return close_.is_more_than(limit) ? limit : close_.penalty(); };
  bool progress = true;
  for (int round = 0; round < most_spreading_rounds && progress && close_.number() > 0; ++round) {
    progress = false;
    close_.try_all_again();
    for (CircleId c; (c = close_.take_worst()).valid();)
      progress |= resampling_.nudge_as_first(trials(domain_.dual().circle(c).sites), cost,
                                             close_.penalty() - least_spread * close_.penalty(c));
  }
  return close_.number() == 0;
}

}  // namespace fpo
