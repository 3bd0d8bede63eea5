#include "geom/dual/planned_removal.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/mirrored_dual.h"
#include "tests/fixtures/whole_diagram.h"

using namespace geom;
using fixtures::check_by_brute_force;
using fixtures::MirroredDual;
using fixtures::Placed;
using fixtures::Weights;
using oracle::KnownCircle;

namespace {

/// Two duals of the same sites.
struct Twins {
  Twins(const TriMesh& mesh, bool search, const std::vector<Placed>& sites)
      : samples(sites), first(mesh, search, CornerTypes::c_only), second(mesh, search, CornerTypes::c_only) {
    first.build(samples);
    second.build(samples);
  }
  std::vector<Placed> samples;
  MirroredDual first, second;
};

/// On every surface, with all weights and both ways to search. `count`: of the sites, by these.
template <class Count, class Visit>
void for_twins(std::uint64_t seed, Count count, Visit visit) {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const bool search : {true, false}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        CAPTURE(search);
        const std::size_t n = count(weights, search);
        Twins twins(surface.mesh, search, fixtures::placed_samples(surface.mesh, n, n, weights, seed));
        visit(twins);
      }
}

}  // namespace

TEST_CASE("planned removal: a move at once is a removal and an insertion") {
  std::size_t at_once = 0, in_place = 0;
  const auto count = [](Weights, bool search) { return search ? std::size_t(60) : std::size_t(6); };
  for_twins(31, count, [&](Twins& twins) {
    auto& [samples, once, steps] = twins;
    const std::size_t n = samples.size();
    Rng rng(3);
    for (int move = 0; move < 120; ++move) {
      CAPTURE(move);
      const SiteId p(static_cast<std::size_t>(rng.below(n)));
      std::optional<PlannedRemoval> plan = once.dual().plan_removal(p);
      if (!plan || plan->circles().empty()) {
        if (plan) once.stay(*plan);
        continue;
      }
      ++at_once;
      PlannedRemoval::Target target{rng.below(plan->circles().size()), CircleId()};
      EmptyCircle circle = plan->circles()[target.planned];
      if (rng.below(3) == 0)  // somewhere else
        for (const CircleId c : once.circles())
          if (!once.dual().circle(c).touches(p) && rng.below(20) == 0)
            target.circle = c, circle = once.dual().circle(c);
      Placed x{{circle.center, once.placed(p).point.weight}, circle.facet};
      if (rng.below(4) == 0) x.point.weight *= 0.5;
      once.move(p, x, *plan, target);
      steps.remove(p);
      steps.insert(p, x);
      once.dual().check();
      REQUIRE(once.known_circles() == steps.known_circles());
      for (std::size_t i = 0; i < n; ++i)
        REQUIRE(once.dual().has_cell(SiteId(i)) == steps.dual().has_cell(SiteId(i)));
    }
    in_place += once.dual().ways().in_place;
    check_by_brute_force(once);
  });
  CHECK(at_once > 1000);
  CHECK(in_place > 20);
}

namespace {

using Told = std::tuple<FacetId, std::array<SiteId, 3>, bool, double, double, double, double>;
Told told(const EmptyCircle& c) {
  return {c.facet, c.sites, c.clockwise, c.center.x(), c.center.y(), c.center.z(), c.radius2};
}
std::vector<Told> told(std::span<const EmptyCircle> circles) {
  std::vector<Told> result;
  for (const EmptyCircle& c : circles) result.push_back(told(c));
  std::ranges::sort(result);
  return result;
}
/// Those of a site that do not touch another one.
std::vector<Told> circles_of(const RestrictedDual& dual, SiteId p, SiteId without) {
  std::vector<Told> result;
  for (const CircleId c : dual.circles_of(p))
    if (!dual.circle(c).touches(without)) result.push_back(told(dual.circle(c)));
  std::ranges::sort(result);
  return result;
}

}  // namespace

TEST_CASE(
    "planned removal: a plan tells the circles and the heirs of the removal, and bounds of both cells") {
  std::size_t plans = 0, fast = 0;
  const auto count = [](Weights weights, bool) {
    return weights == Weights::hiding ? std::size_t(9) : std::size_t(60);
  };
  for_twins(37, count, [&](Twins& twins) {
    auto& [samples, planned, removed] = twins;
    const std::size_t n = samples.size();
    for (std::size_t i = 0; i < n; ++i) {
      CAPTURE(i);
      const SiteId p(i);
      const WeightedPoint3& site = samples[i].point;
      const std::vector<KnownCircle> before = planned.known_circles();
      const auto cells_before = fixtures::WholeDiagram(planned).cells();
      const double reach = removed.dual().reach(p);
      const std::size_t general = planned.dual().ways().general_removals;
      std::optional<PlannedRemoval> plan = planned.dual().plan_removal(p);
      const std::vector<SiteId> winners = removed.remove(p);
      const fixtures::WholeDiagram after(removed);
      std::vector<SiteId> changed;
      for (const auto& [s, cell] : after.cells())
        if (!cells_before.contains(s) || cells_before.at(s) != cell) changed.push_back(s);
      CHECK(winners == changed);
      if (plan) {
        ++plans;
        fast += planned.dual().ways().general_removals == general;
        std::vector<SiteId> heirs(plan->heirs().begin(), plan->heirs().end());
        std::ranges::sort(heirs);
        CHECK(heirs == winners);
        std::vector<Told> created;
        for (const SiteId heir : heirs) {
          const std::vector<Told> all = circles_of(removed.dual(), heir, p);
          std::vector<Told> known = circles_of(planned.dual(), heir, p);
          for (const EmptyCircle& c : plan->circles())
            if (c.touches(heir) && !std::ranges::binary_search(known, told(c))) known.push_back(told(c));
          std::ranges::sort(known);
          CHECK(known == all);
          for (const Told& c : all)
            if (!std::ranges::binary_search(before, oracle::CircleName{std::get<0>(c), 0, std::get<1>(c)}, {},
                                            &KnownCircle::name))
              created.push_back(c);
        }
        std::ranges::sort(created);
        created.erase(std::unique(created.begin(), created.end()), created.end());
        CHECK(told(plan->circles()) == created);
        const double slack = 1e-8 * (std::abs(reach) + site.weight);
        CHECK(plan->reach() >= reach - slack);
        CHECK(plan->reach() <= reach + 100 * slack + 1e-12);
        std::array<PolygonCorner, 3> buffer;
        const FragmentStore& fragments = after.power->fragments();
        for (FacetId t(0); t.index() < removed.dual().mesh().num_facets(); t = FacetId(t.value + 1))
          for (const FragmentId f : fragments.of_facet(t))
            for (const PolygonCorner& c : fragments.corners(f, buffer)) {
              const double now = power(c.point.position, after.power->site(fragments.site(f)));
              if (power(c.point.position, site) < now - 1e-12)  // it was in p's cell
                CHECK(now <= plan->max_radius2() + 1e-8 * (std::abs(now) + 1e-3));
            }
        planned.stay(*plan);
      }
      REQUIRE(planned.known_circles() == before);
      removed.insert(p, samples[i]);
    }
  });
  CHECK(plans > 1000);
  CHECK(fast > 100);
}
