#include "fpo/features/curve_slides.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/mesh/scaling.h"

namespace fpo {

using geom::Vec3;

namespace {

constexpr std::array<double, 10> to_both_sides = {-0.02, 0.02, -0.05, 0.05,  -0.1,
                                                  0.1,   -0.2, 0.2,   -0.33, 0.33};  // in wanted lengths
constexpr double least_gap = 0.6, most_gap = 1.3;

/// How far a gap is from what it may be.
double beyond(double gap) { return std::max({least_gap - gap, gap - most_gap, 0.0}); }

}  // namespace

CurveSlides::CurveSlides(const geom::TriMesh& mesh, const Features& features, const FeatureSamples& samples,
                         const Sizing& sizing)
    : sizing_(sizing), tracks_(samples.samples.size()), beside_(samples.samples.size()) {
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    metrics_.emplace_back(mesh, features.curves[c], sizing);
    loops_.push_back(features.curves[c].loop);
    const std::vector<SiteId>& chain = samples.chains[c];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      beside_[chain[i]].push_back(chain[i + 1]);
      beside_[chain[i + 1]].push_back(chain[i]);
    }
    const std::size_t ends = loops_[c] ? 0 : 1;
    for (std::size_t i = ends; i + 1 < chain.size(); ++i) {
      const SiteId before = i > 0 ? chain[i - 1] : chain[chain.size() - 2];
      if (chain[i].index() >= samples.num_given) tracks_[chain[i]] = {c, before, chain[i + 1]};
    }
  }
}

std::vector<SurfaceSample> CurveSlides::places(const SurfaceDomain& domain, SiteId x) const {
  const auto [before, after] = neighbours(x);
  return places(x, domain.sample(x), {domain.sample(before).position, domain.sample(after).position});
}

std::vector<SurfaceSample> CurveSlides::places(SiteId x, const SurfaceSample& now,
                                               const std::array<Vec3, 2>& beside) const {
  return places(x, now, beside, to_both_sides);
}

std::vector<SurfaceSample> CurveSlides::places(SiteId x, const SurfaceSample& now,
                                               const std::array<Vec3, 2>& beside,
                                               std::span<const double> steps) const {
  const Track& track = tracks_[x];
  const CurveMetric& metric = metrics_[track.curve];
  const double h = sizing_.at(now), t = metric.nearest(now.position).t;
  const auto worst_gap = [&](const Vec3& place) {
    double worst = 0;
    for (const Vec3& y : beside) worst = std::max(worst, beyond((y - place).norm() / h));
    return worst;
  };
  const double worst_now = worst_gap(now.position);
  std::vector<SurfaceSample> result;
  for (const double step : steps) {
    double there = t + step;
    if (loops_[track.curve]) there -= metric.length() * std::floor(there / metric.length());
    if (!(there > 0 && there < metric.length())) continue;
    SurfaceSample place = metric.at(there);
    place.position = geom::snapped(place.position);
    if (worst_gap(place.position) <= worst_now) result.push_back(place);
  }
  return result;
}

bool CurveSlides::has_its_edges(const SurfaceDomain& domain, SiteId x) const {
  std::vector<SiteId> around, link;
  domain.dual().link(x, around);
  around.push_back(x);
  return std::ranges::all_of(around, [&](SiteId y) {
    if (y.index() >= beside_.size()) return true;
    domain.dual().link(y, link);
    return std::ranges::all_of(beside_[y],
                               [&](SiteId z) { return std::ranges::find(link, z) != link.end(); });
  });
}

}  // namespace fpo
