#include "fpo/farthest.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "doctest.h"
#include "fpo/plane/plane_domain.h"
#include "fpo/surface/surface_domain.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

namespace {

double by_height(const Place& place) { return place.position.y() + place.radius2; }
double hardly_by_height(const Place& place) { return 0.002 * place.position.y() + place.radius2; }

/// Those of the table, and one that nobody would want.
std::vector<FarthestRule> rules_and(Priority odd) {
  std::vector<FarthestRule> all(farthest_rules().begin(), farthest_rules().end());
  all.push_back({"odd", odd, ""});
  return all;
}

/// The farthest of the circles that touch any of the samples, one after the other; none if there is none.
CircleId farthest(const SurfaceDomain& domain, const std::vector<SiteId>& of, Priority priority) {
  CircleId best;
  double most = -std::numeric_limits<double>::infinity();
  for (const SiteId x : of)
    for (const CircleId id : domain.dual().circles_of(x)) {
      const geom::EmptyCircle& c = domain.dual().circle(id);
      const double now = priority({c.center, c.radius2, domain.sizing().at({c.center, c.facet})});
      if (best.valid() && (now < most || (now == most && !circle_before(c, domain.dual().circle(best)))))
        continue;
      most = now;
      best = id;
    }
  return best;
}

std::vector<SiteId> all_but(SiteId x, std::size_t n) {
  std::vector<SiteId> all;
  for (std::size_t i = 0; i < n; ++i)
    if (SiteId(i) != x) all.emplace_back(i);
  return all;
}

/// Algorithm 1, lines 5 to 9, by a search in all circles; the domain's own choice plays no part.
void move_slowly(SurfaceDomain& domain, SiteId x, Scope scope, Priority priority) {
  const SurfaceSample home = domain.sample(x);
  const double d2 = domain.separation(x);
  std::vector<SiteId> around = all_but(x, domain.num_samples());
  const bool has_cell = domain.dual().has_cell(x);
  if (!has_cell && scope == Scope::two_ring) around = {domain.dual().nearest(home.position, x).site};
  domain.remove(x);
  if (has_cell && scope == Scope::two_ring) around = domain.last_change().cells;
  const CircleId best = farthest(domain, around, priority);
  if (!best.valid()) return domain.put_back(x);
  const geom::EmptyCircle& c = domain.dual().circle(best);
  const double there = priority({c.center, c.radius2, domain.sizing().at({c.center, c.facet})});
  if (there > priority({home.position, d2, domain.sizing().at(home)}))
    domain.insert_at(x, {c.radius2, best});
  else
    domain.put_back(x);
}

}  // namespace

TEST_CASE("farthest: on a surface a sample goes to the circle of the largest priority, whatever the rule") {
  constexpr std::size_t n = 50;
  for (const auto& surface :
       {fixtures::NamedSurface{"blob", fixtures::blob(8)}, {"box", fixtures::box({1, 2, 1}, 3)}})
    for (const FarthestRule& rule : rules_and(by_height))
      for (const Scope scope : {Scope::global, Scope::two_ring})
        for (const bool steps : {false, true}) {
          CAPTURE(surface.name);
          CAPTURE(std::string(rule.name));
          CAPTURE(steps);
          const Sizing sizing = fixtures::graded(surface.mesh, 0.08, 0.2);
          const auto samples = random_samples(surface.mesh, sizing, n, 8);
          SurfaceOptions options;
          SurfaceDomain slow(surface.mesh, sizing, samples, options);
          options.farthest = rule.priority;
          SurfaceDomain domain(surface.mesh, sizing, samples, options);
          for (std::size_t i = 0; i < 3 * n; ++i) {
            const SiteId x(i % n);
            move_slowly(slow, x, scope, rule.priority);
            steps ? domain.Domain::move(x, scope) : domain.move(x, scope);
            REQUIRE(domain.sample(x).position == slow.sample(x).position);
            REQUIRE(domain.sample(x).facet == slow.sample(x).facet);
          }
          domain.check();
        }
}

TEST_CASE("farthest: in the plane a sample goes to the circle of the largest priority, whatever the rule") {
  constexpr std::size_t n = 60;
  const geom::FlatTorus torus({1, 1});
  for (const std::string name : {"uniform", "waves5"})
    for (const FarthestRule& rule : rules_and(hardly_by_height)) {
      CAPTURE(name);
      CAPTURE(std::string(rule.name));
      const std::unique_ptr<PlaneSizing> sizing = named_sizing(name, torus);
      const PlaneDensity density(*sizing, torus);
      const double scale = density.edge_length_scale(n);
      PlaneOptions options;
      options.farthest = rule.priority;
      PlaneDomain domain(torus, *sizing, scale, initial_plane_samples(density, n, 1), options);
      const geom::Regular2& t = domain.triangulation();
      const auto priority = [&](const geom::Vec2& at, double radius2) {
        return rule.priority({{at.x(), at.y(), 0}, radius2, domain.edge_length(at)});
      };
      for (std::size_t i = 0; i < 4 * n; ++i) {
        const SiteId x(i % n);
        const geom::Vec2 home = t.point(x).position;
        const double stays = priority(home, domain.separation(x));
        domain.remove(x);
        double most = -std::numeric_limits<double>::infinity();
        for (geom::SimplexId c(0); c.index() < t.simplex_capacity(); ++c.value)
          if (t.is_live(c)) most = std::max(most, priority(t.center(c), t.radius2(c)));
        const geom::SimplexId chosen(domain.largest_empty(Scope::global).id.value);
        REQUIRE(priority(t.center(chosen), t.radius2(chosen)) == most);
        const geom::Vec2 there = t.center(chosen);
        domain.put_back(x);
        REQUIRE(domain.move(x, Scope::global) == (most > stays));
        const geom::Vec2 now = t.point(x).position;
        REQUIRE(now == (most > stays ? torus.snap(there) : home));
        domain.check();
      }
    }
}

TEST_CASE("farthest: a rule that is the paper's, but is asked, ends where the paper's does") {
  const geom::TriMesh mesh = fixtures::blob(8);
  constexpr std::size_t n = 60;
  const Sizing sizing = fixtures::graded(mesh, 0.08, 0.2);
  const auto samples = random_samples(mesh, sizing, n, 8);
  SurfaceOptions options;
  SurfaceDomain known(mesh, sizing, samples, options);
  options.farthest = [](const Place& place) { return place.radius2; };
  SurfaceDomain asked(mesh, sizing, samples, options);
  for (std::size_t i = 0; i < 4 * n; ++i) {
    const SiteId x(i % n);
    REQUIRE(known.move(x, Scope::global) == asked.move(x, Scope::global));
    REQUIRE(known.sample(x).position == asked.sample(x).position);
  }
}
