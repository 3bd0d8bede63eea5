#include "fpo/remesh/spreading.h"

#include <algorithm>
#include <array>

#include "fpo/remesh/nearby_places.h"

namespace fpo {

namespace {

constexpr std::array<double, 5> steps = {0.005, 0.01, 0.02, 0.04, 0.08};  // in units of h
constexpr int directions_of_steps = 12;
constexpr int most_rounds = 8;
constexpr double least_spread = 0.02;  // of a triangle's penalty
constexpr double drift_of_lengths = 1e-12;

FlawMeasure short_edges(const SurfaceDomain& domain, double delta) {
  return [&domain, delta](const geom::EmptyCircle& circle) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const SurfaceSample &a = domain.sample(circle.sites[i]), &b = domain.sample(circle.sites[(i + 1) % 3]);
      const double lack = 1 - (a.position - b.position).norm() / (delta * domain.sizing().at(a));
      if (lack > drift_of_lengths) sum += lack * lack;
    }
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
      close_(domain, short_edges(domain, goal.delta)),
      resampling_(domain, with_first(close_, std::move(others)), goal.at_worst) {}

bool Spreading::spread() {
  const PlacesFor around = [&](SiteId x) {
    const SurfaceSample& sample = domain_.sample(x);
    return nearby_places(domain_.mesh(), tree_, sample,
                         {domain_.sizing().at(sample), steps, directions_of_steps});
  };
  const auto cost = [&] { return close_.penalty(); };
  bool progress = true;
  for (int round = 0; round < most_rounds && progress && close_.number() > 0; ++round) {
    progress = false;
    close_.try_all_again();
    for (CircleId c; (c = close_.take_worst()).valid();) {
      const std::array<SiteId, 3> corners = domain_.dual().circle(c).sites;
      progress |= resampling_.nudge(corners, around, cost, cost() - least_spread * close_.penalty(c));
    }
  }
  return close_.number() == 0;
}

}  // namespace fpo
