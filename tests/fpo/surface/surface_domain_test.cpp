#include "fpo/surface/surface_domain.h"

#include <cmath>
#include <limits>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/surface_removal.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;

namespace {

std::vector<SiteId> all_but(std::size_t n, SiteId out) {
  std::vector<SiteId> ids;
  for (std::size_t i = 0; i < n; ++i)
    if (SiteId(i) != out) ids.emplace_back(i);
  return ids;
}

/// The sites as the diagram knows them, weights included.
geom::Clipper::Sites sites_of(const SurfaceDomain& domain) {
  geom::Clipper::Sites sites;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) sites.push_back(domain.dual().site(SiteId(i)));
  return sites;
}

/// The largest power at a corner of any facet clipped for any site by brute force, of type C or of any type.
double largest_by_brute_force(const TriMesh& mesh, const geom::Clipper::Sites& sites,
                              const std::vector<SiteId>& present, bool all_types) {
  const double extent = 10 * mesh.box().min().cwiseAbs().cwiseMax(mesh.box().max().cwiseAbs()).maxCoeff();
  geom::Clipper clipper(mesh, sites, extent);
  geom::FacetPolygon polygon;
  double largest = -std::numeric_limits<double>::infinity();
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const SiteId i : present) {
      clipper.start(polygon, t, i);
      for (const SiteId j : present)
        if (j != i && !polygon.corners.empty()) clipper.clip(polygon, j);
      for (std::size_t k = 0; k < polygon.corners.size(); ++k)
        if (all_types || (polygon.edge_before(k).is_site() && polygon.corners[k].edge.is_site()))
          largest = std::max(largest, geom::power(polygon.corners[k].point.position, sites[i]));
    }
  return largest;
}

}  // namespace

TEST_CASE("surface domain: the largest empty circle is that of brute force, and every structure holds") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    for (const bool adaptive : {false, true}) {
      for (const geom::CornerTypes corners : {geom::CornerTypes::c_only, geom::CornerTypes::all}) {
        const Sizing sizing = adaptive ? fixtures::graded(mesh, 0.08, 0.2) : fixtures::even(mesh, 25);
        SurfaceOptions options;
        options.corners = corners;
        options.engine = adaptive ? Engine::triangulation : Engine::search;
        SurfaceDomain domain(mesh, sizing, random_samples(mesh, sizing, 25, 9), options);
        const double scale = mesh.diagonal() * mesh.diagonal();
        for (std::size_t i = 0; i < 25; ++i) {
          const SiteId x(i);
          domain.remove(x);
          domain.check();
          const Circle c = domain.largest_empty(Scope::global);
          const double largest = largest_by_brute_force(mesh, sites_of(domain), all_but(25, x),
                                                        corners == geom::CornerTypes::all);
          CHECK(c.radius2 == doctest::Approx(largest).epsilon(1e-9).scale(scale));
          CHECK(domain.largest_empty(Scope::two_ring).radius2 <= c.radius2);
          if (c.id.valid() && i % 2 == 0) {
            const Vec3 center = domain.dual().circle(c.id).center;
            domain.insert_at(x, c);
            CHECK(domain.sample(x).position == center);
          } else {
            domain.put_back(x);
          }
          domain.check();
        }
      }
    }
  }
}

TEST_CASE("surface domain: the separation is the least power of a linear scan") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    for (const Engine engine : {Engine::search, Engine::triangulation}) {
      const Sizing sizing = fixtures::graded(mesh, 0.08, 0.2);
      SurfaceOptions options;
      options.engine = engine;
      SurfaceDomain domain(mesh, sizing, random_samples(mesh, sizing, 60, 2), options);
      const geom::Clipper::Sites sites = sites_of(domain);
      for (std::size_t i = 0; i < 60; ++i) {
        const Vec3 x = sites[SiteId(i)].position;
        const SiteId nearest = oracle::nearest(x, sites, all_but(60, SiteId(i)));
        CHECK(domain.separation(SiteId(i)) == geom::power(x, sites[nearest]));
      }
    }
  }
}

TEST_CASE("surface domain: the normalized spacing is the distance to the nearest sample in hexagonal units") {
  const TriMesh mesh = fixtures::blob(4);
  constexpr std::size_t n = 80;
  SurfaceDomain domain(mesh, random_samples(mesh, n, 4));
  const double d_max = std::sqrt(2 * mesh.area() / (std::sqrt(3.0) * n));
  for (std::size_t i = 0; i < n; ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < n; ++j)
      if (j != i)
        least =
            std::min(least, (domain.sample(SiteId(i)).position - domain.sample(SiteId(j)).position).norm());
    CHECK(domain.normalized_spacing(SiteId(i)) == doctest::Approx(least / d_max));
  }
}

TEST_CASE("surface domain: samples at one place, a single sample, none") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  const SurfaceSample corner{Vec3(0, 0, 0), FacetId(0)}, middle = location_in_facet(mesh, FacetId(3), .3, .3);
  for (const Engine engine : {Engine::search, Engine::triangulation}) {
    SurfaceOptions options;
    options.engine = engine;
    SurfaceDomain twins(mesh, std::vector{corner, corner, middle, middle, middle}, options);
    twins.check();
    CHECK(twins.num_hidden() == 3);
    for (std::size_t i = 0; i < 5; ++i) CHECK(twins.separation(SiteId(i)) == 0);
    for (std::size_t i = 0; i < 5; ++i) {
      twins.remove(SiteId(i));
      twins.check();
      twins.put_back(SiteId(i));
      twins.check();
    }
    SurfaceDomain alone(mesh, std::vector{middle}, options);
    CHECK(alone.separation(SiteId(0)) == std::numeric_limits<double>::infinity());
    alone.remove(SiteId(0));
    CHECK(alone.largest_empty(Scope::global).radius2 == -std::numeric_limits<double>::infinity());
    alone.put_back(SiteId(0));
    alone.check();
    CHECK_THROWS_AS(SurfaceDomain(mesh, std::vector<SurfaceSample>(), options), geom::InputError);
  }
}

TEST_CASE("surface domain: degenerate facets are borne") {
  // A triangle with a fourth point in the middle of one side, so that a facet without area fills the gap to
  // the two triangles beyond; and a triangle whose corners are at one place.
  const auto v = [](int i) { return geom::VertexId(i); };
  const TriMesh mesh(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.4, 1, 0.1), Vec3(0.5, 0, 0), Vec3(0.6, -1, 0.2), Vec3(1, 0, 0),
       Vec3(1, 0, 0)},
      {{v(0), v(1), v(2)}, {v(1), v(0), v(3)}, {v(0), v(4), v(3)}, {v(3), v(4), v(1)}, {v(1), v(5), v(6)}});
  for (const Engine engine : {Engine::search, Engine::triangulation}) {
    SurfaceOptions options;
    options.engine = engine;
    SurfaceDomain domain(mesh, random_samples(mesh, 40, 4), options);
    domain.check();
    for (std::size_t move = 0; move < 200; ++move) {
      domain.move(SiteId(move % 40), Scope::global);
      domain.check();
    }
  }
}

TEST_CASE("surface domain: both engines go the same way, move by move") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const Sizing sizing = fixtures::graded(mesh, 0.08, 0.2);
    const auto samples = random_samples(mesh, sizing, 50, 6);
    SurfaceOptions options;
    SurfaceDomain a(mesh, sizing, samples, options);
    options.engine = Engine::triangulation;
    options.seed = 77;  // of the order of the first insertions: no matter
    SurfaceDomain b(mesh, sizing, samples, options);
    for (std::size_t i = 0; i < 150; ++i) {
      const SiteId x(i % 50);
      REQUIRE(a.separation(x) == b.separation(x));
      REQUIRE(a.normalized_spacing(x) == b.normalized_spacing(x));
      a.remove(x), b.remove(x);
      const Scope scope = i % 2 == 0 ? Scope::global : Scope::two_ring;
      const Circle c = a.largest_empty(scope), d = b.largest_empty(scope);
      REQUIRE(c.radius2 == d.radius2);
      if (!c.id.valid()) {
        a.put_back(x), b.put_back(x);
      } else {
        a.insert_at(x, c), b.insert_at(x, d);
      }
      REQUIRE(a.sample(x).position == b.sample(x).position);
    }
    CHECK(a.diagram()->canonical() == b.diagram()->canonical());
  }
}

namespace {

/// Forbids what its fields say.
class TestGuard final : public MoveGuard {
 public:
  bool may_vacate(SurfaceRemoval& removal, Scope) override {
    asked_of_plans += removal.is_planned();
    const SurfaceRemoval::Vacancy vacancy = removal.vacancy();
    CHECK(!vacancy.around.empty());
    return vacates;
  }
  bool offers(const geom::EmptyCircle& c, const geom::WeightedPoint3&) const override {
    return c.center.x() <= most_x;
  }
  bool may_keep(SurfaceDomain&, SiteId, const geom::EmptyCircle&) override { return keeps; }

  double most_x = std::numeric_limits<double>::infinity();
  bool vacates = true, keeps = true;
  int asked_of_plans = 0;
};

/// Lines 5 to 9 of Algorithm 1, each by itself.
bool move_in_steps(SurfaceDomain& domain, SiteId x, Scope scope) { return domain.Domain::move(x, scope); }

}  // namespace

TEST_CASE("surface domain: a move at once ends where the steps of Algorithm 1 do") {
  for (const auto& surface : fixtures::surfaces())
    for (const Scope scope : {Scope::global, Scope::two_ring})
      for (const bool adaptive : {false, true})
        for (const bool offers_half : {false, true}) {
          if (offers_half && scope == Scope::two_ring) continue;  // steps take what is not offered there
          CAPTURE(surface.name);
          CAPTURE(adaptive);
          CAPTURE(offers_half);
          constexpr std::size_t n = 60;
          const Sizing sizing =
              adaptive ? fixtures::graded(surface.mesh, 0.08, 0.2) : fixtures::even(surface.mesh, n);
          SurfaceOptions options;
          options.engine = adaptive ? Engine::triangulation : Engine::search;
          TestGuard guard;
          if (offers_half) guard.most_x = surface.mesh.box().center().x();
          const auto samples = random_samples(surface.mesh, sizing, n, 8);
          SurfaceDomain at_once(surface.mesh, sizing, samples, options, &guard),
              in_steps(surface.mesh, sizing, samples, options, &guard);
          for (std::size_t i = 0; i < 4 * n; ++i) {
            const SiteId x(i % n);
            const bool moved = move_in_steps(in_steps, x, scope);
            REQUIRE(at_once.move(x, scope) == moved);
            at_once.check();
            REQUIRE(at_once.sample(x).position == in_steps.sample(x).position);
            REQUIRE(at_once.sample(x).facet == in_steps.sample(x).facet);
          }
          CHECK(at_once.diagram()->canonical() == in_steps.diagram()->canonical());
          CHECK(guard.asked_of_plans > static_cast<int>(2 * n));
        }
}

TEST_CASE("surface domain: what a guard forbids is as if it had not been tried") {
  for (const auto& surface : fixtures::surfaces())
    for (const geom::CornerTypes corners : {geom::CornerTypes::c_only, geom::CornerTypes::all}) {
      CAPTURE(surface.name);
      constexpr std::size_t n = 40;
      SurfaceOptions options;
      options.corners = corners;
      const Sizing sizing = fixtures::even(surface.mesh, n);
      const auto samples = random_samples(surface.mesh, n, 3);
      TestGuard guard;
      SurfaceDomain domain(surface.mesh, sizing, samples, options, &guard),
          free(surface.mesh, sizing, samples, options);
      int forbidden = 0;
      for (std::size_t i = 0; i < 3 * n; ++i) {
        const SiteId x(i % n);
        const Scope scope = i % 2 == 0 ? Scope::global : Scope::two_ring;
        const SurfaceSample old = domain.sample(x);
        guard.vacates = i % 3 != 0;
        guard.keeps = i % 3 != 1;
        const MoveOutcome outcome = domain.try_move(x, scope);
        if (outcome == MoveOutcome::forbidden) {
          ++forbidden;
          REQUIRE(domain.sample(x).position == old.position);
          REQUIRE(domain.sample(x).facet == old.facet);
          REQUIRE(domain.diagram()->canonical() == free.diagram()->canonical());
        } else {
          REQUIRE(guard.vacates);
          REQUIRE(free.move(x, scope) == (outcome == MoveOutcome::moved));
          REQUIRE(domain.sample(x).position == free.sample(x).position);
        }
        domain.check();
      }
      CHECK(forbidden > static_cast<int>(n));
    }
}

// Of several sites that might inherit something of a cell not all do: the 2-ring is around those that do.
TEST_CASE("surface domain: a local move at once among many components") {
  const TriMesh mesh = fixtures::islands();
  constexpr std::size_t n = 21;
  const Sizing sizing = fixtures::even(mesh, n);
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    CAPTURE(seed);
    const auto samples = random_samples(mesh, sizing, n, seed);
    SurfaceDomain at_once(mesh, sizing, samples, {}), in_steps(mesh, sizing, samples, {});
    for (std::size_t i = 0; i < 3 * n; ++i) {
      const SiteId x(i % n);
      move_in_steps(in_steps, x, Scope::two_ring);
      at_once.move(x, Scope::two_ring);
      REQUIRE(at_once.sample(x).position == in_steps.sample(x).position);
    }
  }
}
