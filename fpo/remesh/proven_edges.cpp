#include "fpo/remesh/proven_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geom/power/clip_predicates.h"

namespace fpo {

using geom::Location3;
using geom::SiteId;
using geom::Vec3;
using geom::VertexId;
using geom::WeightedPoint3;

namespace {

constexpr double margin = 1e-12;  // of all that is added: some thousand roundings
constexpr double more = 1 + 1e-9;
constexpr double around = 1e-6;  // of a mesh edge, about the place: what is beaten there need not be asked

/// By how much a site is farther in power than another at both ends of a mesh edge; affine between.
struct Lead {
  double at_from, at_to, size;
  double at(double t) const { return (1 - t) * at_from + t * at_to; }
};

class EmptyBalls {
 public:
  explicit EmptyBalls(const SurfaceDomain& domain) : domain_(domain) {}

  /// Does the curve pass from the cell of a to that of b? If so, nothing is lacking; if not, what is lacking
  /// where that is least.
  OpenBall ball(const FeatureCurve& curve, SiteId a, SiteId b) {
    OpenBall ball{a, b, std::numeric_limits<double>::infinity(), {}};
    for (std::size_t i = 0; i < curve.facets.size(); ++i) {
      const Location3 from = vertex(curve.vertices[i]),
                      to = vertex(curve.vertices[(i + 1) % curve.vertices.size()]);
      if (!geom::beats_at_vertex(from, ranked(a), ranked(b)) &&
          geom::beats_at_vertex(to, ranked(a), ranked(b))) {
        if (is_empty(from, to, a, b)) return {a, b, 0, {}};
        if (most_lead_ < ball.lack) ball.lack = most_lead_, ball.deepest = deepest_;
      }
    }
    return ball;
  }

 private:
  Location3 vertex(VertexId v) const { return {domain_.mesh().position(v), domain_.mesh().level(v)}; }
  const WeightedPoint3& site(SiteId x) const { return domain_.dual().site(x); }
  geom::RankedPoint3 ranked(SiteId x) const { return {&site(x), x.value}; }

  Lead lead(const Location3& from, const Location3& to, SiteId a, SiteId x) const {
    const double xf = power(from, site(x)), xt = power(to, site(x)), af = power(from, site(a)),
                 at = power(to, site(a));
    const double weights = 2 * (site(x).weight + site(a).weight);
    return {xf - af, xt - at, std::abs(xf) + std::abs(xt) + std::abs(af) + std::abs(at) + 2 * weights};
  }

  /// At the place of the mesh edge that is as far from a as from b. Who is nearer there may own it if a is
  /// gone.
  bool is_empty(const Location3& from, const Location3& to, SiteId a, SiteId b) {
    const Lead f = lead(from, to, a, b);
    const double t = f.at_from > f.at_to ? f.at_from / (f.at_from - f.at_to) : 0;
    double low = std::max(0.0, t - around), high = std::min(1.0, t + around);
    if (low > 0 && !(f.at(low) > margin * f.size)) low = 0;  // the place is surely between
    if (high < 1 && !(f.at(high) < -margin * f.size)) high = 1;
    const Vec3 first = (1 - low) * from.position + low * to.position,
               last = (1 - high) * from.position + high * to.position, middle = 0.5 * (first + last);
    const double most = std::max(geom::power(first, site(a)), geom::power(last, site(a)));
    near_.clear();
    most_lead_ = 0;
    bool empty = true;
    domain_.dual().tree().heirs(
        {a, middle, more * (last - middle).norm(), most + margin * (std::abs(most) + f.size)}, near_);
    for (const SiteId x : near_) {
      if (x == a || x == b) continue;
      const Lead g = lead(from, to, a, x);
      if (std::min(g.at(low), g.at(high)) > margin * g.size) continue;
      if (!geom::beats_on_edge(from, to, ranked(a), ranked(b), ranked(x))) continue;
      empty = false;
      const double lead = -g.at((low + high) / 2);
      if (lead > most_lead_) most_lead_ = lead, deepest_ = x;
    }
    return empty;
  }

  const SurfaceDomain& domain_;
  double most_lead_ = 0;      ///< of others over both, where is_empty() looked last
  SiteId deepest_;            ///< whose that is
  std::vector<SiteId> near_;  // workspace
};

}  // namespace

std::vector<OpenBall> open_balls(const SurfaceDomain& domain, const Features& features,
                                 const FeatureSamples& samples) {
  EmptyBalls balls(domain);
  std::vector<OpenBall> open;
  for (std::size_t c = 0; c < samples.chains.size(); ++c)
    for (std::size_t i = 0; i + 1 < samples.chains[c].size(); ++i) {
      const SiteId a = samples.chains[c][i], b = samples.chains[c][i + 1];
      const OpenBall ball = balls.ball(features.curves[c], a, b);
      if (ball.lack > 0) open.push_back(ball);
    }
  return open;
}

std::size_t num_proven_edges(const SurfaceDomain& domain, const Features& features,
                             const FeatureSamples& samples) {
  return num_edges(samples) - open_balls(domain, features, samples).size();
}

}  // namespace fpo
