// What stands while sites move a little: by brute force where they have moved, and when it ends.

#include "geom/dual/leeway.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "geom/dual/leeway_proof.h"
#include "geom/dual/restricted_dual.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/dual_scene.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;
using fixtures::Placed;

namespace {

/// As even as random samples become by thinning: of each ten the farthest from those before.
std::vector<Placed> even_samples(const TriMesh& mesh, std::size_t n) {
  const std::vector<Placed> all = fixtures::placed_samples(mesh, 10 * n, n, fixtures::Weights::none, 5);
  std::vector<Placed> even;
  for (std::size_t i = 0; i < n; ++i) {
    double most = -1;
    Placed best = all[10 * i];
    for (std::size_t k = 10 * i; k < 10 * i + 10; ++k) {
      double least = infinity;
      for (const Placed& p : even)
        least = std::min(least, (p.point.position - all[k].point.position).squaredNorm());
      if (least > most) most = least, best = all[k];
    }
    even.push_back(best);
  }
  return even;
}

std::vector<fixtures::NamedSurface> smooth_surfaces() {
  return {{"sphere", make_shape("sphere", 8)},
          {"torus", fixtures::torus(1, 0.4, {40, 24, true, true, 0})},
          {"cube", fixtures::box(Vec3(1, 1, 1), 4)},
          {"plate", fixtures::box(Vec3(1, 0.8, 0.02), 3)}};
}

struct LeewayScene : fixtures::DualScene {
  LeewayScene(const TriMesh& mesh, std::size_t n)
      : DualScene(mesh, even_samples(mesh, n)), around(state), proof(around) {}
  /// That of p, as a move finds it.
  const Leeway* find(SiteId p) {
    around.p = p;
    around.forget();
    if (!around.rim.open_star(state, p)) return nullptr;
    around.see_rim();
    state.leeways.arrive(p, 0);
    return proof.find();
  }
  Surroundings around;
  LeewayProof proof;
};

Vec3 random_location(const TriMesh& mesh, FacetId t, Rng& rng) {
  const double s = rng.uniform(), r = rng.uniform() * (1 - s);
  return mesh.corner(t, 0) + s * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
         r * (mesh.corner(t, 2) - mesh.corner(t, 0));
}

Vec3 way(double most, Rng& rng) {
  return 0.999 * most * rng.uniform() * fixtures::random_vector(rng).normalized();
}

/// All sites as far off as the leeway of p allows.
std::vector<Vec3> moved_places(const LeewayScene& scene, SiteId p, const Leeway& leeway, Rng& rng) {
  const double step = scene.state.leeways.step();
  std::vector<Vec3> places;
  for (const SiteId s : scene.present) {
    const Vec3& at = scene.state.sites[s].position;
    const bool is_watched = std::ranges::find(leeway.all(), s, &Leeway::Watched::site) != leeway.all().end();
    if (s == p || is_watched)
      places.push_back(at + way(s == p ? leeway.own_delta : leeway.delta, rng));
    else  // towards p
      places.push_back(at + 2 * step * (leeway.origin - at).normalized());
  }
  return places;
}

}  // namespace

TEST_CASE("leeway: wherever sites move, the nearest but p is of the rim or kept, and no farther than said") {
  Rng rng(1);
  std::size_t leeways = 0, locations = 0, kept = 0;
  for (const fixtures::NamedSurface& surface : smooth_surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    LeewayScene scene(mesh, 250);
    REQUIRE(scene.state.leeways.is_in_use());
    for (const SiteId p : scene.present) {
      const Leeway* leeway = scene.find(p);
      if (!leeway) continue;
      ++leeways;
      kept += leeway->num_kept;
      std::vector<FacetId> near;
      scene.state.facets.near(leeway->origin, leeway->radius, near);
      for (int time = 0; time < fixtures::effort(4, 20); ++time) {
        const std::vector<Vec3> places = moved_places(scene, p, *leeway, rng);
        for (int i = 0; i < 100; ++i) {
          const Vec3 z = random_location(mesh, near[static_cast<std::size_t>(rng.below(near.size()))], rng);
          if ((z - leeway->origin).norm() > leeway->radius) continue;
          ++locations;
          SiteId nearest;
          double least = infinity;
          for (const SiteId s : scene.present)
            if (const double far2 = (z - places[s.index()]).squaredNorm(); s != p && far2 < least)
              least = far2, nearest = s;
          const auto known = leeway->all().first(leeway->num_rim + leeway->num_kept);
          CHECK(std::ranges::find(known, nearest, &Leeway::Watched::site) != known.end());
          double of_rim = infinity;
          for (const Leeway::Watched& r : leeway->rim())
            of_rim = std::min(of_rim, (z - places[r.site.index()]).squaredNorm());
          CHECK(of_rim - scene.state.sites[p].weight <= leeway->power);
        }
      }
    }
  }
  CHECK(leeways > 50);
  CHECK(locations > 3000);
  CHECK(kept > 20);
}

TEST_CASE("leeway: who is nearest is told by it as by all sites") {
  const TriMesh mesh = make_shape("sphere", 8);
  LeewayScene scene(mesh, 250);
  int told = 0;
  for (const SiteId p : scene.present) {
    told += scene.find(p) != nullptr;
    const WeightedPoint3& point = scene.state.sites[p];
    SiteId nearest;
    double least = infinity;
    for (const SiteId s : scene.present)
      if (const double far2 = power(Location3(point.position, point.level), scene.state.sites[s]);
          s != p && far2 < least)
        least = far2, nearest = s;
    const auto found = scene.state.nearest({point.position, point.level}, p);
    CHECK(found.site == nearest);
    CHECK(found.radius2 == least);
  }
  CHECK(told > 30);
}

TEST_CASE("leeway: it ends when somebody moves too far, comes near, or weighs something else") {
  const TriMesh mesh = make_shape("sphere", 8);
  LeewayScene scene(mesh, 250);
  DualState& state = scene.state;
  Leeways& all = state.leeways;
  int tried = 0;
  const auto put = [&](SiteId s, const Vec3& place) {
    const Vec3 from = state.sites[s].position;
    state.sites[s].position = place;
    state.follow(s, from);
  };
  for (const SiteId p : scene.present) {
    const Leeway* leeway = scene.find(p);
    if (!leeway || all.of(p) != leeway) continue;
    ++tried;
    const double delta = leeway->delta, own_delta = leeway->own_delta;
    const Vec3 origin = leeway->origin, along = leeway->u;
    for (const SiteId s : {leeway->rim().front().site, leeway->all().back().site}) {
      const Vec3 was = state.sites[s].position;
      put(s, was + 0.99 * delta * along);
      CHECK(all.of(p) == leeway);
      put(s, was + 1.02 * delta * along);
      CHECK(all.of(p) == nullptr);
      put(s, was);
      CHECK(all.of(p) == leeway);
    }
    put(p, origin + 0.99 * own_delta * along);
    CHECK(all.of(p) == leeway);
    put(p, origin);
    const auto is_known = [&](SiteId s) {
      return s == p || std::ranges::find(leeway->all(), s, &Leeway::Watched::site) != leeway->all().end();
    };
    const SiteId stranger = *std::ranges::find_if_not(scene.present, is_known);
    const Vec3 home = state.sites[stranger].position;
    SUBCASE("a stranger comes and goes") { put(stranger, origin + 0.9 * leeway->watch * along); }
    SUBCASE("a stranger goes out and comes in nearby") {
      state.leave(stranger);
      CHECK(all.of(p) == leeway);
      state.sites[stranger].position = origin + 0.9 * leeway->watch * along;
      state.enter(stranger);
    }
    SUBCASE("p is elsewhere for a while") {
      put(p, origin + 1.02 * own_delta * along);
      put(p, origin);
    }
    SUBCASE("p goes out") {
      state.leave(p);
      state.enter(p);
    }
    CHECK(all.of(p) == nullptr);
    if (state.sites[stranger].position != home) put(stranger, home);
    CHECK(all.of(p) == nullptr);
  }
  CHECK(tried > 30);
  state.admit(SiteId(0), {state.sites[SiteId(0)].position, 1e-6});
  CHECK(!all.is_in_use());
}

namespace {

/// Even samples on a surface and their dual, moved round by round to the largest circles of their holes.
struct MovedDual {
  MovedDual(const TriMesh& surface, std::size_t n) : mesh(surface), dual(mesh, CornerTypes::c_only) {
    for (const Placed& sample : even_samples(mesh, n)) {
      order.emplace_back(points.size());
      points.push_back(sample.point);
      homes.push_back(sample.home);
    }
    dual.build(points, homes, order, 1);
  }
  void move(SiteId p, double more_weight = 0) {
    std::optional<PlannedRemoval> plan = dual.plan_removal(p);
    if (!plan || plan->circles().empty()) return;
    const auto largest = std::ranges::max_element(plan->circles(), {}, &EmptyCircle::radius2);
    const auto place = static_cast<std::size_t>(largest - plan->circles().begin());
    WeightedPoint3& point = points[p.index()];
    point.position = largest->center;
    point.weight += more_weight;
    homes[p.index()] = largest->facet;
    plan->move(point, homes[p.index()], {place, CircleId()});
  }
  void round() {
    for (const SiteId p : order) move(p);
  }
  /// Is the dual the one that is built from nothing, and does it know who is nearest?
  void check() const {
    dual.check();
    RestrictedDual rebuilt(mesh, CornerTypes::c_only);
    rebuilt.build(points, homes, order, 1);
    REQUIRE(circles_of(dual) == circles_of(rebuilt));
    for (const SiteId p : order) {
      const Location3 x(points[p.index()].position, 0);
      double least = infinity;
      for (const SiteId s : order)
        if (s != p) least = std::min(least, power(x, points[s.index()]));
      CHECK(dual.nearest(x, p).radius2 == least);
    }
  }
  static std::vector<std::array<SiteId, 3>> circles_of(const RestrictedDual& dual) {
    std::vector<std::array<SiteId, 3>> all;
    for (const CircleId c : dual.circles()) {
      all.push_back(dual.circle(c).sites);
      std::ranges::sort(all.back());
    }
    std::ranges::sort(all);
    return all;
  }

  const TriMesh& mesh;
  std::vector<WeightedPoint3> points;
  std::vector<FacetId> homes;
  std::vector<SiteId> order;
  RestrictedDual dual;
};

}  // namespace

TEST_CASE("leeway: moves with it lead to the diagram built from nothing") {
  for (const fixtures::NamedSurface& surface : smooth_surfaces()) {
    CAPTURE(surface.name);
    MovedDual moved(surface.mesh, 220);
    for (int round = 0; round < fixtures::effort(12, 40); ++round) {
      moved.round();
      moved.check();
    }
    if (surface.name != std::string("plate"))  // where no sheet is apart from the other
      CHECK(moved.dual.ways().with_leeway >= 200);
  }
}

TEST_CASE("leeway: there is none after a move to another weight, and who is nearest is still known") {
  const TriMesh mesh = make_shape("sphere", 8);
  for (const std::size_t q : {std::size_t{3}, std::size_t{40}, std::size_t{65}}) {
    MovedDual moved(mesh, 120);
    for (int round = 0; round < 12; ++round) moved.round();
    const std::size_t before = moved.dual.ways().with_leeway;
    CHECK(before > 50);
    for (int times = 0; times < 8; ++times) {
      moved.move(SiteId(q), 0.05 * mesh.area() / 120);
      moved.check();
    }
    for (int round = 0; round < 2; ++round) {
      moved.round();
      moved.check();
    }
    CHECK(moved.dual.ways().with_leeway == before);
  }
}
