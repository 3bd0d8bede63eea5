#include "fpo/plane/vacated_place.h"

#include <algorithm>

#include "fpo/rings.h"

namespace fpo {

using geom::Regular2;
using geom::SimplexId;

void VacatedPlace::note(SiteId x, bool uniform) {
  left_ = triangulation_.point(x);
  const bool hidden = triangulation_.is_hidden(x);
  owned_itself_ = uniform && !hidden;
  near_ = SiteId();
  if (owned_itself_) return;
  const Regular2::Nearest nearest = triangulation_.nearest_other(x);
  separation_ = nearest.power;
  if (hidden) near_ = nearest.id;
}

/// A sample whose place is in its own cell borders its nearest one, which then is a corner of the triangles
/// in its hole.
bool VacatedPlace::is_beaten_by(SimplexId t, double radius2, const Regular2::Change& change) const {
  const double most = circles_.priority(triangulation_.center(t), radius2);
  const auto is_nearer = [&](double power) { return most > circles_.priority(left_.position, power); };
  if (!owned_itself_) return is_nearer(separation_);
  return std::ranges::any_of(change.created, [&](SimplexId in_hole) {
    return std::ranges::any_of(triangulation_.corners(in_hole), [&](SiteId v) {
      const geom::Vec2 d = triangulation_.torus().shortest(triangulation_.point(v).position - left_.position);
      return is_nearer(d.squaredNorm());
    });
  });
}

SimplexId VacatedPlace::first_around(const Regular2::Change& change) {
  SimplexId best;
  const auto consider = [&](SimplexId t, int) {
    if (!best.valid() || circles_.goes_before(t, best)) best = t;
  };
  ring_.clear();
  if (near_.valid()) ring_.push_back(near_);
  for (const SimplexId t : change.created) add_missing(ring_, triangulation_.corners(t));
  for (const SiteId v : ring_) triangulation_.visit_star(v, consider);
  return best;
}

}  // namespace fpo
