// The fast way by itself: what it calls regular is so, before and after everything that it does; what it
// plans is what the general way does; and it refuses what it cannot know.

#include "geom/dual/fast_way.h"

#include <algorithm>
#include <memory>
#include <set>

#include "doctest.h"
#include "geom/dual/redivision.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::Placed;
using fixtures::Weights;
using oracle::KnownCircle;
using Shape = geom::CellShape;

namespace {

/// A dual in its parts: the fast way where it goes, else the general one.
struct Parts {
  Parts(const TriMesh& mesh, const std::vector<Placed>& samples)
      : state(mesh, CornerTypes::c_only, nullptr), fast(state), redivision(state) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      state.admit(SiteId(i), samples[i].point);
      state.home[SiteId(i)] = samples[i].home;
      state.search.enter(SiteId(i));
      present.insert(SiteId(i));
    }
    DualChange change;
    redivision.build(1, {}, change);
    look_again();
  }

  bool remove(SiteId p) {
    DualChange change;
    const bool is_fast = fast.plan(p);
    if (is_fast) {
      fast.remove(change);
    } else {
      redivision.removal().plan(p);
      redivision.removal().commit(change);
      state.set_shape(p, Shape::regular);
    }
    present.erase(p);
    finish(change, is_fast);
    return is_fast;
  }
  bool insert(SiteId p, const Placed& x, CircleId at) {
    DualChange change;
    const bool is_fast = at.valid() && fast.insert(p, x.point, x.home, at, change);
    if (!is_fast) {
      redivision.insert(p, x.point, change);
      state.home[p] = x.home;
    }
    present.insert(p);
    finish(change, is_fast);
    return is_fast;
  }
  /// After the general way everything is looked at again.
  void finish(const DualChange& change, bool is_fast) {
    state.circles.recycle(change.circles_erased);
    if (is_fast) return;
    look_again();
  }
  void look_again() {
    for (const SiteId s : present) fast.certify(s);
  }
  bool is_regular(SiteId s) const { return state.shapes[s] == Shape::regular; }
  void set_regular(SiteId s, bool value) { state.set_shape(s, value ? Shape::regular : Shape::irregular); }

  std::vector<SiteId> present_list() const { return {present.begin(), present.end()}; }
  CircleId any_circle(Rng& rng, SiteId near) const {
    std::vector<CircleId> all;
    for (const SiteId s : present)
      if (!near.valid() || s == near)
        for (const CircleId c : state.circles.of_site(s)) all.push_back(c);
    return all.empty() ? CircleId() : all[rng.below(all.size())];
  }

  DualState state;
  FastWay fast;
  Redivision redivision;
  std::set<SiteId> present;
};

/// Of the sites that are called regular, how many are there; all are what they are called.
std::size_t check_regular(const Parts& parts) {
  const oracle::BruteDiagram brute(parts.state.mesh, parts.state.sites, parts.present_list());
  std::size_t regular = 0;
  for (const SiteId s : parts.present) {
    if (!parts.is_regular(s)) continue;
    ++regular;
    CHECK_MESSAGE(brute.is_simple(s), "site " << s.value);
  }
  CHECK(regular + parts.state.shapes.not_regular().size() == parts.present.size());
  return regular;
}

std::vector<fixtures::NamedSurface> all_surfaces() {
  std::vector<fixtures::NamedSurface> all = fixtures::hard_surfaces();
  for (fixtures::NamedSurface& s : fixtures::surfaces()) all.push_back(std::move(s));
  return all;
}

/// The most power of those left, at corners of their cells that p would own.
double power_in_hole(const TriMesh& mesh, const Clipper::Sites& sites, const oracle::BruteDiagram& without,
                     SiteId p) {
  Clipper clipper(mesh, sites, extent_of(mesh));
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& [key, polygon] : without.polygons())
    for (std::size_t k = 0; k < polygon.corners.size(); ++k)
      if (clipper.beats_at(polygon, k, p, clipper.bisector_of(polygon.owner, p)))
        most = std::max(most, power(polygon.corners[k].point.position, sites[polygon.owner]));
  return most;
}

/// On a flat square, but for what is given; the middle site is in a ring of six.
std::vector<Placed> ring(const TriMesh& mesh, double radius) {
  std::vector<Placed> samples;
  const Vec3 middle = mesh.box().center() + Vec3(0.0123, 0.0171, 0);
  const auto place = [&](const Vec3& at) {
    Placed x{{at, 0}, FacetId()};
    double least = std::numeric_limits<double>::infinity();
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
      const TrianglePoint q = closest_point(at, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
      if (q.distance2 < least) least = q.distance2, x = {{q.point, 0}, t};
    }
    samples.push_back(x);
  };
  place(middle);
  for (int i = 0; i < 6; ++i)
    place(middle + (1 + 0.03 * i) * radius * Vec3(std::cos(i + 0.1), std::sin(i + 0.1), 0));
  for (int i = 0; i < 11; ++i)
    place(middle + 2 * radius * Vec3(std::cos(0.57 * i + 0.2), std::sin(0.57 * i + 0.2), 0));
  return samples;
}

}  // namespace

TEST_CASE(
    "fast way: a site that is called regular has a cell in one piece with one border through its circles") {
  std::size_t regular = 0, sites = 0;
  for (const auto& surface : all_surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const std::size_t n : {12u, 50u, 130u}) {
        if (n * surface.mesh.num_facets() > 30000) continue;
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        CAPTURE(n);
        const Parts parts(surface.mesh, fixtures::placed_samples(surface.mesh, n, n, weights, 21));
        regular += check_regular(parts);
        sites += n;
      }
  CHECK(regular > 1000);
  CHECK(regular + 1000 < sites);
}

TEST_CASE("fast way: on smooth surfaces nearly all sites are regular") {
  for (const TriMesh& mesh : {make_shape("sphere", 6), fixtures::torus(1, 0.4, {24, 14, true, true, 0.2})}) {
    const Parts parts(mesh, fixtures::placed_samples(mesh, 300, 300, Weights::none, 3));
    CHECK(check_regular(parts) > 290);
  }
}

// Who is regular is found out once; fast removals and insertions then are to keep it true for all around.
TEST_CASE("fast way: regular sites stay so under its moves") {
  std::size_t fast = 0, general = 0;
  for (const auto& surface : all_surfaces())
    for (const Weights weights : {Weights::none, Weights::gentle})
      for (const std::size_t n : {25u, 90u}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        CAPTURE(n);
        const std::vector<Placed> pool = fixtures::placed_samples(surface.mesh, 20 * n, n, weights, 8);
        Parts parts(surface.mesh, {pool.begin(), pool.begin() + static_cast<std::ptrdiff_t>(n)});
        Rng rng(n);
        for (int move = 0; move < fixtures::effort(8, 24); ++move) {
          CAPTURE(move);
          const SiteId p(static_cast<std::size_t>(rng.below(n)));
          (parts.remove(p) ? fast : general) += 1;
          if (move % 4 == 0) check_regular(parts);
          Placed x = pool[n + rng.below(pool.size() - n)];
          CircleId at;
          if (rng.below(5) != 0) {
            at = parts.any_circle(rng, SiteId());
            if (at.valid())
              x = {{parts.state.circles[at].center, x.point.weight}, parts.state.circles[at].facet};
          }
          (parts.insert(p, x, at) ? fast : general) += 1;
          if (move % 4 == 1) check_regular(parts);
        }
        check_regular(parts);
        const oracle::BruteDiagram brute(surface.mesh, parts.state.sites, parts.present_list());
        std::size_t circles = 0;
        for (const KnownCircle& c : brute.dual(CornerTypes::c_only).circles) {
          ++circles;
          const auto known = [&](CircleId id) {
            return parts.state.circles[id].facet == c.name.facet &&
                   parts.state.circles[id].sites == c.name.sites;
          };
          CHECK(std::ranges::count_if(parts.state.circles.of_site(c.name.sites[0]), known) == 1);
        }
        CHECK(parts.state.circles.size() == circles);
      }
  CHECK(fast > fixtures::effort<std::size_t>(500, 800));
  CHECK(general > fixtures::effort<std::size_t>(500, 800));
}

TEST_CASE("fast way: a plan changes nothing, and tells what the hole will have") {
  const TriMesh torus = fixtures::torus(1, 0.4, {24, 14, true, true, 0.2});
  const std::size_t n = 120;
  Parts parts(torus, fixtures::placed_samples(torus, n, n, Weights::gentle, 4));
  std::size_t plans = 0, exact = 0;
  const oracle::BruteDiagram present(torus, parts.state.sites, parts.present_list());
  const std::size_t every = fixtures::effort<std::size_t>(2, 1);
  for (std::size_t i = 0; i < n; i += every) {
    const SiteId p(i);
    const std::size_t before = parts.state.circles.size();
    if (!parts.fast.plan(p)) continue;
    ++plans;
    CHECK(parts.state.circles.size() == before);
    CHECK(parts.state.search.tree().contains(p));
    const std::size_t m = parts.fast.rim().size();
    CHECK(parts.fast.circles().size() == m - 2);
    CHECK(parts.state.circles.of_site(p).size() == m);
    CHECK(std::set<SiteId>(parts.fast.rim().begin(), parts.fast.rim().end()).size() == m);
    std::vector<SiteId> others = parts.present_list();
    std::erase(others, p);
    const oracle::BruteDiagram brute(torus, parts.state.sites, others);
    const double reach = parts.fast.reach(), most = parts.fast.max_radius2();
    CHECK(reach >= present.reach(p) * (1 - 1e-9));
    const double in_hole = power_in_hole(torus, parts.state.sites, brute, p);
    CHECK(most >= in_hole * (1 - 1e-9));
    for (const EmptyCircle& c : parts.fast.circles()) CHECK(c.radius2 <= most);
    if (parts.fast.make_plan_exact()) {
      ++exact;
      CHECK(parts.fast.reach() <= reach * (1 + 1e-6));
      CHECK(parts.fast.max_radius2() <= most * (1 + 1e-6));
      CHECK(parts.fast.reach() == doctest::Approx(present.reach(p)).epsilon(1e-6));
      CHECK(parts.fast.max_radius2() == doctest::Approx(std::max(in_hole, present.reach(p))).epsilon(1e-6));
    }
    for (const EmptyCircle& c : parts.fast.circles()) {
      CHECK(c.radius2 <= parts.fast.max_radius2());
      const std::vector<KnownCircle> on_facet = brute.circles_on(c.facet, CornerTypes::c_only);
      CHECK(std::ranges::count(on_facet, c.sites, [](const KnownCircle& k) { return k.name.sites; }) == 1);
    }
    parts.fast.cancel();
  }
  CHECK(plans > n / every / 2);
  CHECK(exact > n / every / 2);
}

TEST_CASE("fast way: the quick bounds of a plan are no less than the least ones, and not much larger") {
  std::size_t exact = 0, quick = 0;
  for (const Weights weights : {Weights::none, Weights::gentle}) {
    const TriMesh sphere = make_shape("sphere", 8);
    const std::size_t n = 600;
    Parts parts(sphere, fixtures::placed_samples(sphere, n, n, weights, 6));
    for (std::size_t i = 0; i < n; ++i) {
      if (!parts.fast.plan(SiteId(i))) continue;
      const double reach = parts.fast.reach(), most = parts.fast.max_radius2();
      for (const EmptyCircle& c : parts.fast.circles()) CHECK(c.radius2 <= most);
      if (parts.fast.make_plan_exact()) {
        ++exact;
        const double least = parts.fast.reach(), least_of_hole = parts.fast.max_radius2();
        quick += most > least_of_hole * (1 + 1e-6);
        CHECK(reach >= least * (1 - 1e-9));
        CHECK(most >= least_of_hole * (1 - 1e-9));
        CHECK(reach <= 1.5 * least + 0.01);
      }
      parts.fast.cancel();
    }
  }
  CHECK(exact > 600);
  CHECK(quick > 100);
}

// What is on the other side of a gap, and nearer to a part of the hole than all around it.
TEST_CASE("fast way: a stranger that owns something is not overlooked") {
  for (const double gap : {1e-9, 0.01, 0.05, 0.3}) {
    CAPTURE(gap);
    Table<VertexId, Vec3> v;
    Table<FacetId, TriMesh::Facet> f;
    fixtures::add_grid(v, f, 9, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    fixtures::add_grid(v, f, 9, Vec3(0, 0, gap), Vec3(1, 0, 0), Vec3(0, 1, 0));
    const TriMesh sheets(std::move(v), std::move(f));
    std::vector<Placed> samples = ring(fixtures::sheet(9, 1, [](double, double) { return 0.0; }), 0.2);
    const std::size_t alone = samples.size();
    Parts without(sheets, samples);
    samples.push_back(samples[0]);  // above the middle one
    samples.back().point.position += Vec3(0.01, -0.02, gap);
    samples.back().home = FacetId(samples[0].home.value + 162);
    Parts with(sheets, samples);
    check_regular(with);
    check_regular(without);
    CHECK(with.present.size() == alone + 1);
    for (Parts* const parts : {&without, &with}) {
      const bool planned = parts->fast.plan(SiteId(0));
      std::vector<SiteId> others = parts->present_list();
      std::erase(others, SiteId(0));
      const oracle::BruteDiagram before(sheets, parts->state.sites, parts->present_list()),
          after(sheets, parts->state.sites, others);
      if (!planned) continue;
      for (const EmptyCircle& c : parts->fast.circles()) {
        const std::vector<KnownCircle> on_facet = after.circles_on(c.facet, CornerTypes::c_only);
        CHECK(std::ranges::count(on_facet, c.sites, [](const KnownCircle& k) { return k.name.sites; }) == 1);
      }
      parts->fast.cancel();
    }
    if (gap < 0.1) CHECK(!with.fast.plan(SiteId(0)));  // it gets a part of the hole
  }
}

// Whatever their cells.
TEST_CASE(
    "fast way: an irregular site is not taken out; who is put in must reach all circles that such a one may "
    "lose") {
  const TriMesh flat = fixtures::sheet(
      9, 1, [](double, double) { return 0.0; }, 0.2);
  const std::vector<Placed> samples = ring(flat, 0.15);
  Parts parts(flat, samples);
  REQUIRE(parts.is_regular(SiteId(0)));
  REQUIRE(parts.fast.plan(SiteId(0)));
  parts.fast.cancel();
  parts.set_regular(SiteId(0), false);
  CHECK(!parts.fast.plan(SiteId(0)));
  parts.set_regular(SiteId(0), true);
  const CircleId at = parts.state.circles.of_site(SiteId(0)).front();
  const EmptyCircle circle = parts.state.circles[at];
  const SiteId hidden(samples.size()), p(samples.size() + 1);
  parts.insert(hidden, {{samples[0].point.position + Vec3(0.001, 0, 0), -0.1}, FacetId()}, CircleId());
  REQUIRE(parts.state.circles.of_site(hidden).empty());
  // It has a cell somewhere, maybe, that no circle leads to.
  parts.set_regular(hidden, false);
  parts.state.reach.set(hidden, 0.5);
  DualChange change;
  CHECK(!parts.fast.insert(p, {circle.center, 0}, circle.facet, at, change));
  CHECK(change.circles_created.empty());
  CHECK(change.circles_erased.empty());
  CHECK(!parts.state.search.tree().contains(p));
  parts.state.reach.set(hidden, -std::numeric_limits<double>::infinity());
  for (const SiteId loser : circle.sites)
    parts.set_regular(loser, false);  // all of their circles are looked at
  CHECK(parts.fast.insert(p, {circle.center, 0}, circle.facet, at, change));
  CHECK(parts.is_regular(p));
  for (const SiteId loser : circle.sites) CHECK(!parts.is_regular(loser));
}

TEST_CASE("fast way: without a home, at a circle that is not beaten, or with all corners, nothing is done") {
  const TriMesh flat = fixtures::sheet(
      9, 1, [](double, double) { return 0.0; }, 0.2);
  const std::vector<Placed> samples = ring(flat, 0.15);
  Parts parts(flat, samples);
  const CircleId at = parts.state.circles.of_site(SiteId(0)).front();
  const EmptyCircle circle = parts.state.circles[at];
  const SiteId p(samples.size());
  DualChange change;
  CHECK(!parts.fast.insert(p, {circle.center, 0}, FacetId(), at, change));
  CHECK(!parts.fast.insert(p, {circle.center, -2 * std::abs(circle.radius2)}, circle.facet, at, change));
  CHECK(!parts.fast.insert(p, {circle.center, 0}, FacetId(0), at, change));  // far from its home
  CHECK(change.circles_created.empty());
  CHECK(parts.state.search.size() == samples.size());
  for (const SiteId s : parts.present) parts.set_regular(s, true);
  CHECK(parts.fast.insert(p, {circle.center, 0}, circle.facet, at, change));  // else it is the rule
  CHECK(parts.state.search.size() == samples.size() + 1);
  CHECK(change.circles_created.size() == change.circles_erased.size() + 2);
  DualState all(flat, CornerTypes::all, nullptr);
  FastWay fast(all);
  all.admit(SiteId(0), samples[0].point);
  CHECK(!fast.plan(SiteId(0)));
  fast.certify(SiteId(0));
  CHECK(all.shapes[SiteId(0)] == Shape::irregular);
  CHECK(!fast.insert(SiteId(1), samples[1].point, samples[1].home, CircleId(), change));
}
