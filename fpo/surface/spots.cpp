#include "fpo/surface/spots.h"

#include <algorithm>
#include <limits>

namespace fpo {

namespace {

constexpr double says_something = 0.9;

}  // namespace

void Spots::add(const std::vector<Spot>& spots) {
  std::vector<Spot> ascending = spots;
  std::ranges::stable_sort(ascending, {}, &Spot::h);
  for (const Spot& spot : ascending) {
    if (!(spot.h < says_something * bound(spot.at, std::numeric_limits<double>::infinity()))) continue;
    spots_.insert(std::ranges::upper_bound(spots_, spot.h, {}, &Spot::h), spot);
  }
}

double Spots::bound(const geom::Vec3& x, double most) const {
  for (const Spot& spot : spots_) {
    if (spot.h >= most) break;
    const double reach = (most - spot.h) / gradation_, distance2 = (x - spot.at).squaredNorm();
    if (distance2 < reach * reach) most = spot.h + gradation_ * std::sqrt(distance2);
  }
  return most;
}

}  // namespace fpo
