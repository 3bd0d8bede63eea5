#include "fpo/surface/circle_heap.h"

#include <vector>

#include "doctest.h"
#include "fpo/surface/surface_domain.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

namespace {

/// Offers what lies on one side of a plane.
class HalfSpace final : public MoveGuard {
 public:
  explicit HalfSpace(double most) : most_(most) {}
  bool may_vacate(SurfaceRemoval&, Scope) override { return true; }
  bool offers(const geom::EmptyCircle& circle, const geom::WeightedPoint3&) const override {
    return circle.center.x() < most_;
  }
  bool may_keep(SurfaceDomain&, SiteId, const geom::EmptyCircle&) override { return true; }

 private:
  double most_;
};

/// The first of the circles on these cells, by a look at each; those that `counts` wants.
template <class Counts>
CircleId first_of(const SurfaceDomain& domain, std::size_t cells, Priority rule, Counts counts) {
  CircleId best;
  double most = 0;
  for (std::size_t i = 0; i < cells; ++i)
    for (const CircleId id : domain.dual().circles_of(SiteId(i))) {
      const geom::EmptyCircle& c = domain.dual().circle(id);
      if (!counts(c)) continue;
      const double now = rule({c.center, c.radius2, domain.sizing().at({c.center, c.facet})});
      if (best.valid() && (now < most || (now == most && !circle_before(c, domain.dual().circle(best)))))
        continue;
      best = id;
      most = now;
    }
  return best;
}

}  // namespace

TEST_CASE("circle heap: the top is the first of all offered circles, after every change") {
  constexpr std::size_t n = 40;
  for (const auto& surface : fixtures::surfaces())
    for (const FarthestRule& rule : farthest_rules()) {
      CAPTURE(surface.name);
      CAPTURE(rule.name);
      const Sizing sizing = fixtures::graded(surface.mesh, 0.08, 0.2);
      HalfSpace guard(surface.mesh.box().center().x());
      SurfaceDomain domain(surface.mesh, sizing, random_samples(surface.mesh, sizing, n, 5));
      CircleHeap guarded(domain.dual(), {rule.priority, domain.sizing()}, &guard),
          free(domain.dual(), {rule.priority, domain.sizing()}, nullptr);
      geom::RestrictedDual::Change all;
      for (std::size_t i = 0; i < n; ++i)
        for (const CircleId c : domain.dual().circles_of(SiteId(i)))
          if (domain.dual().circle(c).sites[0] == SiteId(i)) all.circles_created.push_back(c);
      guarded.apply(all);
      free.apply(all);
      const auto compare_free = [&] {
        free.check();
        const auto any = [](const geom::EmptyCircle&) { return true; };
        REQUIRE(free.top() == first_of(domain, n, rule.priority, any));
      };
      const auto compare_guarded = [&] {
        guarded.check();
        const auto offered = [&](const geom::EmptyCircle& c) { return guarded.is_offered(c); };
        const auto any = [](const geom::EmptyCircle&) { return true; };
        REQUIRE(guarded.top() == first_of(domain, n, rule.priority, offered));
        const std::vector<SiteId> two{SiteId(0), SiteId(1)};
        REQUIRE(guarded.first_on(two) == first_of(domain, 2, rule.priority, any));
      };
      compare_free();
      compare_guarded();
      struct Relay final : Follower<geom::RestrictedDual::Change> {
        std::vector<CircleHeap*> heaps;
        void follow(const geom::RestrictedDual::Change& change) override {
          for (CircleHeap* heap : heaps) heap->apply(change);
        }
      } relay;
      relay.heaps = {&guarded, &free};
      domain.followers().add(relay);
      for (std::size_t i = 0; i < n; ++i) {
        domain.move(SiteId(i), i % 2 == 0 ? Scope::global : Scope::two_ring);
        compare_free();
        if (i % 8 == 3) guarded.forget();
        if (i % 8 != 3 && i % 8 != 4) compare_guarded();  // changes come while it follows nothing, too
      }
      domain.followers().remove(relay);
    }
}
