#include "fpo/farthest.h"

namespace fpo {
namespace {

/// Where circles are large for what the sizing wants.
double by_relative_radius(const Place& place) { return place.radius2 / (place.wanted * place.wanted); }

}  // namespace

std::span<const FarthestRule> farthest_rules() {
  static constexpr FarthestRule table[] = {
      {"radius", by_radius, "the largest empty circle, as in the paper"},
      {"relative", by_relative_radius, "the one that is largest for the wanted length there"}};
  return table;
}

}  // namespace fpo
