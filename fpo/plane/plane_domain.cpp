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

std::vector<WeightedPoint2> weighted_points(const geom::FlatTorus& torus, const PlaneWeights& weights,
                                            std::span<const Vec2> samples,
                                            std::span<const std::uint32_t> order) {
  std::vector<WeightedPoint2> points;
  points.reserve(order.size());
  for (const std::uint32_t i : order) {
    const Vec2 x = torus.snap(samples[i]);
    points.push_back({x, weights.full_weight(x)});
  }
  return points;
}

}  // namespace

PlaneDomain::PlaneDomain(const geom::FlatTorus& torus, const PlaneSizing& sizing, double edge_length_scale,
                         std::span<const Vec2> samples, const PlaneOptions& options)
    : PlaneDomain(torus, PlaneWeights(sizing, edge_length_scale, options.weight_factor), samples, options,
                  curve_order(torus, samples)) {}

PlaneDomain::PlaneDomain(const geom::FlatTorus& torus, const PlaneWeights& weights,
                         std::span<const Vec2> samples, const PlaneOptions& options,
                         const std::vector<std::uint32_t>& order)
    : weights_(weights),
      input_index_(order.begin(), order.end()),
      triangulation_(torus.period(), weighted_points(torus, weights, samples, order)),
      circles_(triangulation_, {options.farthest, weights_}),
      vacated_(triangulation_, circles_) {}

void PlaneDomain::remove(SiteId x) {
  vacated_.note(x, is_uniform());
  apply(triangulation_.remove(x));
}

Circle PlaneDomain::largest_empty(Scope scope) {
  const SimplexId t = scope == Scope::global ? circles_.top() : vacated_.first_around(last_change_);
  return {triangulation_.radius2(t), CircleId(t.value)};
}

bool PlaneDomain::is_farther(const Circle& c, SiteId) {
  return vacated_.is_beaten_by(SimplexId(c.id.value), c.radius2, last_change_);
}

void PlaneDomain::insert_at(SiteId x, const Circle& c) {
  const SimplexId t(c.id.value);
  const Vec2 at = triangulation_.center(t);
  const double weight = is_uniform() ? 0 : weights_.weight(x, torus().snap(at));
  apply(triangulation_.insert(x, {at, weight}, t));
}

void PlaneDomain::insert_at(SiteId x, const Vec2& position, double weight_share) {
  weights_.set_share(x, weight_share, num_samples());
  const Vec2 at = torus().snap(position);
  apply(triangulation_.insert(x, {at, weights_.weight(x, at)}));
}

void PlaneDomain::put_back(SiteId x) { apply(triangulation_.insert(x, vacated_.point())); }

void PlaneDomain::apply(const Regular2::Change& change) {
  circles_.apply(change);
  last_change_ = change;
  followers_.tell(last_change_);
}

/// First the site, then a triangle at it, then the triangles and sites around that.
void PlaneDomain::expect(SiteId x) {
  using enum Regular2::Ahead;
  expected_.announce(x, [this](SiteId y, int calls) {
    triangulation_.prefetch(y, calls == 4 ? site : calls == 3 ? corner : calls == 2 ? around : star);
  });
}

double PlaneDomain::normalized_spacing(SiteId x) {
  double least2 = std::numeric_limits<double>::infinity();
  const auto look_at = [&](SiteId y) {
    least2 = std::min(least2, triangulation_.difference(x, y).squaredNorm());
  };
  if (triangulation_.is_hidden(x))
    look_at(triangulation_.nearest_other(x).id);
  else
    triangulation_.visit_star(x, [&](SimplexId t, int corner) {
      look_at(triangulation_.corners(t)[static_cast<std::size_t>(corner == 2 ? 0 : corner + 1)]);
    });
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
