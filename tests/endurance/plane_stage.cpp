#include "tests/endurance/plane_stage.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"

namespace endurance {

using geom::SimplexId;
using geom::SiteId;
using geom::Vec2;
using geom::Vec3;

namespace {

constexpr int anchors_per_side = 6, num_anchors = anchors_per_side * anchors_per_side;

std::vector<geom::WeightedPoint2> anchors(const Vec2& period) {
  std::vector<geom::WeightedPoint2> points;
  for (int i = 0; i < anchors_per_side; ++i)
    for (int j = 0; j < anchors_per_side; ++j)
      points.push_back({period.cwiseProduct(Vec2(i, j)) / anchors_per_side, 0});
  return points;
}

/// Anchors have the smallest ids.
SiteId anchored(SiteId s) { return SiteId(s.value + num_anchors); }

}  // namespace

PlaneStage::PlaneStage(const Place& place)
    : place_(place), triangulation_(place.period, anchors(place.period)) {}

// A change that would leave a gap is refused by geom::InputError before anything is modified.
bool PlaneStage::insert(SiteId s, const geom::WeightedPoint3& point) try {
  note(triangulation_.insert(anchored(s), {point.position.head<2>(), point.weight}));
  return true;
} catch (const geom::InputError&) {
  return false;
}

bool PlaneStage::remove(SiteId s) try {
  note(triangulation_.remove(anchored(s)));
  return true;
} catch (const geom::InputError&) {
  return false;
}

void PlaneStage::note(const geom::Regular2::Change& change) {
  last_created_.assign(change.created.begin(), change.created.end());
}

bool PlaneStage::farthest(bool of_last_change, Vec3& out) const {
  SimplexId best;
  const auto look_at = [&](SimplexId t) {
    if (triangulation_.is_live(t) &&
        (!best.valid() || triangulation_.radius2(t) > triangulation_.radius2(best)))
      best = t;
  };
  if (of_last_change)
    for (const SimplexId t : last_created_) look_at(t);
  else
    for (std::size_t t = 0; t < triangulation_.simplex_capacity(); ++t) look_at(SimplexId(t));
  if (best.valid()) out = {triangulation_.center(best).x(), triangulation_.center(best).y(), 0};
  return best.valid();
}

Vec3 PlaneStage::anywhere(bool special, geom::Rng& rng) const {
  Vec2 share(rng.uniform(), rng.uniform());
  if (special) {
    if (rng.below(3) == 0 && !present().empty())
      return point(present()[rng.below(present().size())]).position;
    for (double& x : share) x = static_cast<double>(rng.below(4 * anchors_per_side)) / (4 * anchors_per_side);
  }
  const Vec2 x = share.cwiseProduct(place_.period);
  return {x.x(), x.y(), 0};
}

std::vector<SiteId> PlaneStage::all_sites() const {
  std::vector<SiteId> ids;
  for (std::size_t i = 0; i < num_anchors; ++i) ids.emplace_back(i);
  for (const SiteId s : present()) ids.push_back(anchored(s));
  return ids;
}

void PlaneStage::check_by_brute_force(geom::Rng& rng) const {
  const std::vector<SiteId> ids = all_sites();
  check_nearest(ids[rng.below(ids.size())]);
  SimplexId t;
  do t = SimplexId(static_cast<std::size_t>(rng.below(triangulation_.simplex_capacity())));
  while (!triangulation_.is_live(t));
  check_empty(t);
}

void PlaneStage::check_nearest(SiteId id) const {
  geom::Regular2::Nearest best{SiteId(), INFINITY};
  for (const SiteId s : all_sites()) {
    if (s == id) continue;
    const Vec2 d = triangulation_.difference(id, s);
    const double power = d.x() * d.x() + d.y() * d.y() - triangulation_.point(s).weight;
    if (power < best.power) best = {s, power};
  }
  const auto found = triangulation_.nearest_other(id);
  geom::ensure(found.id == best.id && found.power == best.power, "brute force finds another nearest site");
}

/// No site is closer to the center than the corners, but for rounding.
void PlaneStage::check_empty(SimplexId t) const {
  const double radius2 = triangulation_.radius2(t), unit2 = std::pow(triangulation_.torus().unit(), 2);
  for (const SiteId s : all_sites()) {
    const geom::WeightedPoint2 p = triangulation_.point(s);
    const double power =
        triangulation_.torus().shortest(p.position - triangulation_.center(t)).squaredNorm() - p.weight;
    geom::ensure(power >= radius2 - 1e-9 * (unit2 + std::abs(p.weight)), "a circle is not empty");
  }
}

std::unique_ptr<Stage> PlaneStage::rebuilt() const {
  auto other = std::make_unique<PlaneStage>(place_);
  copy_sites_to(*other);
  return other;
}

std::vector<PlaneStage::Keyed> PlaneStage::triangles() const {
  std::vector<Keyed> result;
  for (std::size_t i = 0; i < triangulation_.simplex_capacity(); ++i) {
    const SimplexId t(i);
    if (!triangulation_.is_live(t)) continue;
    Keyed keyed{triangulation_.corners(t), triangulation_.radius2(t)};
    std::rotate(keyed.corners.begin(), std::ranges::min_element(keyed.corners), keyed.corners.end());
    result.push_back(keyed);
  }
  std::ranges::sort(result);
  return result;
}

void PlaneStage::compare(const Stage& other) const {
  const auto& that = dynamic_cast<const PlaneStage&>(other);
  geom::ensure(triangles() == that.triangles(), "the triangulation built from nothing differs");
  for (const SiteId s : all_sites())
    geom::ensure(triangulation_.is_hidden(s) == that.triangulation_.is_hidden(s),
                 "other sites are hidden in the triangulation built from nothing");
}

}  // namespace endurance
