#include "fpo/plane/plane_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/hilbert.h"

namespace fpo {

using geom::Regular2;
using geom::SimplexId;
using geom::Vec2;
using geom::WeightedPoint2;

namespace {

std::vector<std::uint32_t> curve_order(const geom::FlatTorus& torus, std::span<const Vec2> samples) {
  geom::require(samples.size() >= least_plane_samples,
                "a periodic domain needs at least " + std::to_string(least_plane_samples) + " samples");
  std::vector<Vec2> positions;
  positions.reserve(samples.size());
  for (const Vec2& x : samples) {
    geom::require(x.allFinite(), "a sample's position is not finite");
    positions.push_back(torus.snap(x));
  }
  return geom::hilbert_order(positions, torus.period());
}

}  // namespace

PlaneDomain::PlaneDomain(const geom::FlatTorus& torus, const PlaneSizing& sizing, double edge_length_scale,
                         std::span<const Vec2> samples, const PlaneOptions& options)
    : PlaneDomain(torus, sizing, edge_length_scale, samples, options, curve_order(torus, samples)) {}

PlaneDomain::PlaneDomain(const geom::FlatTorus& torus, const PlaneSizing& sizing, double edge_length_scale,
                         std::span<const Vec2> samples, const PlaneOptions& options,
                         const std::vector<std::uint32_t>& order)
    : sizing_(sizing),
      scale_(edge_length_scale),
      weight_factor_(sizing.is_uniform() ? 0 : options.weight_factor),
      input_index_(order.begin(), order.end()),
      triangulation_(torus.period(),
                     [&] {
                       std::vector<WeightedPoint2> points;
                       points.reserve(order.size());
                       for (const std::uint32_t i : order) {
                         const Vec2 x = torus.snap(samples[i]);
                         points.push_back({x, weight_at(x)});
                       }
                       return points;
                     }()),
      circles_(triangulation_, {options.farthest, sizing, edge_length_scale}) {}

double PlaneDomain::weight_at(const Vec2& x) const {
  if (weight_factor_ == 0) return 0;
  const double radius = weight_factor_ * edge_length(x);
  return radius * radius;
}

void PlaneDomain::remove(SiteId x) {
  removed_ = triangulation_.point(x);
  const bool hidden = triangulation_.is_hidden(x);
  owns_its_place_ = is_uniform() && !hidden;
  near_removed_ = SiteId();
  if (!owns_its_place_) {
    const Regular2::Nearest nearest = triangulation_.nearest_other(x);
    removed_separation_ = nearest.power;
    if (hidden) near_removed_ = nearest.id;
  }
  apply(triangulation_.remove(x));
}

/// A sample whose place is in its own cell borders its nearest one, which then is a corner of the triangles
/// in its hole.
bool PlaneDomain::is_farther(const Circle& c, SiteId) {
  const SimplexId t(c.id.value);
  const double most = circles_.priority(triangulation_.center(t), c.radius2);
  const auto is_nearer = [&](double radius2) { return most > circles_.priority(removed_.position, radius2); };
  if (!owns_its_place_) return is_nearer(removed_separation_);
  return std::ranges::any_of(last_change_.created, [&](SimplexId t) {
    return std::ranges::any_of(triangulation_.corners(t), [&](SiteId v) {
      const Vec2 d = torus().shortest(triangulation_.point(v).position - removed_.position);
      return is_nearer(d.squaredNorm());
    });
  });
}

Circle PlaneDomain::largest_empty(Scope scope) {
  const SimplexId t = scope == Scope::global ? circles_.top() : largest_in_two_ring();
  return {triangulation_.radius2(t), CircleId(t.value)};
}

/// Among the triangles with a corner in the link of the removed sample, those that fill its hole included: a
/// disk of two rings around it.
SimplexId PlaneDomain::largest_in_two_ring() {
  SimplexId best;
  const auto consider = [&](SimplexId t, int) {
    if (!best.valid() || circles_.goes_before(t, best)) best = t;
  };
  ring_.clear();
  if (near_removed_.valid()) ring_.push_back(near_removed_);
  for (const SimplexId t : last_change_.created) {
    for (const SiteId v : triangulation_.corners(t))
      if (std::find(ring_.begin(), ring_.end(), v) == ring_.end()) ring_.push_back(v);
  }
  for (const SiteId v : ring_) triangulation_.visit_star(v, consider);
  return best;
}

void PlaneDomain::insert_at(SiteId x, const Circle& c) {
  const SimplexId t(c.id.value);
  const Vec2 at = triangulation_.center(t);
  const double weight = is_uniform() ? 0 : weight_share(x) * weight_at(torus().snap(at));
  apply(triangulation_.insert(x, {at, weight}, t));
}

void PlaneDomain::insert_at(SiteId x, const Vec2& position, double weight_share) {
  geom::ensure(weight_share > 0 && weight_share <= 1, "the share of a weight must be in (0, 1]");
  if (weight_share_.empty() && weight_share < 1) weight_share_.assign(num_samples(), 1.0);
  if (!weight_share_.empty()) weight_share_[x] = weight_share;
  const Vec2 at = torus().snap(position);
  apply(triangulation_.insert(x, {at, weight_share * weight_at(at)}));
}

void PlaneDomain::put_back(SiteId x) { apply(triangulation_.insert(x, removed_)); }

void PlaneDomain::apply(const Regular2::Change& change) {
  circles_.apply(change);
  last_change_ = change;
  followers_.tell(last_change_);
}

/// Loads in three steps, a move apart, for each needs what the one before has loaded: the site, a triangle at
/// it, the triangles and sites around that.
void PlaneDomain::expect(SiteId x) {
  using enum Regular2::Ahead;
  triangulation_.prefetch(x, site);
  if (expected_[0].valid()) triangulation_.prefetch(expected_[0], corner);
  if (expected_[1].valid()) triangulation_.prefetch(expected_[1], around);
  if (expected_[2].valid()) triangulation_.prefetch(expected_[2], star);
  expected_ = {x, expected_[0], expected_[1]};
}

double PlaneDomain::edge_length(SiteId x) const {
  if (weight_factor_ == 0) return scale_;
  return std::sqrt(triangulation_.point(x).weight / weight_share(x)) / weight_factor_;
}

double PlaneDomain::normalized_spacing(SiteId x) {
  double least2 = std::numeric_limits<double>::infinity();
  if (triangulation_.is_hidden(x)) {
    least2 = triangulation_.difference(x, triangulation_.nearest_other(x).id).squaredNorm();
  } else {
    triangulation_.visit_star(x, [&](SimplexId t, int corner) {
      const SiteId y = triangulation_.corners(t)[static_cast<std::size_t>(corner == 2 ? 0 : corner + 1)];
      least2 = std::min(least2, triangulation_.difference(x, y).squaredNorm());
    });
  }
  return std::sqrt(least2) / edge_length(x);
}

std::size_t PlaneDomain::num_hidden() const {
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < num_samples(); ++i) hidden += triangulation_.is_hidden(SiteId(i));
  return hidden;
}

std::vector<PlaneSample> PlaneDomain::samples() const {
  std::vector<PlaneSample> all(num_samples());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const WeightedPoint2 p = triangulation_.point(SiteId(i));
    all[input_index_[SiteId(i)]] = {p.position, p.weight};
  }
  return all;
}

void PlaneDomain::check() const {
  triangulation_.check();
  circles_.check();
}

}  // namespace fpo
