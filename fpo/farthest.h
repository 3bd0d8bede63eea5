#pragma once
// Which place is the farthest point: the rule of Algorithm 1, line 6 (paper, section 2.1), in one place.

#include <span>

#include "geom/vec.h"

namespace fpo {

/// Where a sample may be: the center of an empty circle, or where the sample that is out came from.
struct Place {
  geom::Vec3 position;  ///< in the plane (x, y, 0)
  double radius2;       ///< its power to the nearest sample
  double wanted;        ///< the edge length that the sizing wants there
};

/// The farthest point is the empty circle of the largest priority, and a sample leaves its place for it only
/// if it has a larger priority than that place. What relies on it:
///   - It is a function of the place alone, not of history: a circle keeps its key in the heap
///     (CircleHeap, CircleQueue) until it moves, and the bar of CircleQueue is one of such keys.
///   - At one place it does not fall when radius2 rises: so a sample that any one other sample is near enough
///     to leaves (SurfaceState::is_farther() and VacatedPlace look at the heirs first).
///   - Different circles hardly ever have the same one (a rule that rounds will not do). Ties are broken by
///     what the circles are (circle_before, cell_before), which changes while a heap is brought up to date.
/// Nothing else relies on it: who is nearest to whom, the bounds of cells, the certificates of moves and of
/// tiles are about powers, not about priorities. Never NaN. Any rule that has these properties will do;
/// tests/fpo/farthest_test.cpp compares each one of the table with a search in all circles.
using Priority = double (*)(const Place&);

/// The paper's rule: the largest circle.
inline double by_radius(const Place& place) { return place.radius2; }

/// The priority of a place where edges of length wanted() are; asked only by a rule that looks at it.
template <class Wanted>
double priority_by(Priority rule, const geom::Vec3& position, double radius2, Wanted&& wanted) {
  return rule == by_radius ? radius2 : rule({position, radius2, wanted()});
}

struct FarthestRule {
  const char* name;
  Priority priority;
  const char* help;
};

/// All rules that tools offer, the paper's first. Another one is a file and a line there.
std::span<const FarthestRule> farthest_rules();

}  // namespace fpo
