#include "geom/restricted_power.h"

#include <memory>
#include <optional>
#include <set>
#include <tuple>

#include "doctest.h"
#include "fpo/initial_samples.h"
#include "geom/rng.h"
#include "geom/site_tree.h"
#include "geom/triangulation_source.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace geom;

namespace {

/// A diagram with its neighbour source and the set of sites that are in.
struct Diagram {
  Diagram(const TriMesh& mesh, bool search, CornerTypes types)
      : source(search ? std::unique_ptr<NeighbourSource>(new SiteTree)
                      : std::unique_ptr<NeighbourSource>(new TriangulationSource(mesh.box()))),
        power(mesh, *source, types) {}

  void insert(SiteId p, const WeightedPoint3& point) {
    source->insert(p, point, present.empty() ? SiteId() : *present.begin());
    apply(power.after_insert(p, point));
    present.insert(p);
    if (p.index() >= sites.size()) sites.resize(p.index() + 1);
    sites[p] = point;
  }
  void remove(SiteId p) {
    source->remove(p);
    apply(power.after_remove(p));
    present.erase(p);
  }
  /// At once; false if there is no plan for that.
  bool move(SiteId p, const WeightedPoint3& point) {
    source->remove(p);
    const std::optional<RestrictedPower::Plan> plan = power.plan_removal(p);
    const bool stays = !plan || point.position == sites[p].position;
    const SiteId hint = *present.begin() == p ? *present.rbegin() : *present.begin();
    source->insert(p, stays ? sites[p] : point, hint);
    if (stays)
      power.stay(p);
    else
      apply(power.after_move(p, point));
    if (plan) sites[p] = point;
    return plan.has_value();
  }
  void apply(const RestrictedPower::Change& change) {
    for (const CircleId c : change.circles_moved) CHECK(circles.contains(c));
    for (const CircleId c : change.circles_erased) CHECK(circles.erase(c) == 1);
    for (const CircleId c : change.circles_created) CHECK(circles.insert(c).second);
  }
  std::vector<SiteId> present_list() const { return {present.begin(), present.end()}; }

  std::unique_ptr<NeighbourSource> source;
  RestrictedPower power;
  std::set<SiteId> present;
  std::set<CircleId> circles;  ///< as told by the changes
  Clipper::Sites sites;
};

double polygon_area(std::span<const PolygonCorner> corners) {
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (corners[k].point.position - corners[0].point.position)
               .cross(corners[k + 1].point.position - corners[0].point.position);
  return 0.5 * sum.norm();
}

double total_area(const RestrictedPower& power) {
  double sum = 0;
  std::array<PolygonCorner, 3> buffer;
  for (FacetId t(0); t.index() < power.mesh().num_facets(); t = FacetId(t.value + 1))
    for (const FragmentId f : power.fragments().of_facet(t))
      sum += polygon_area(power.fragments().corners(f, buffer));
  return sum;
}

/// Random samples on the surface with weights of the given kind.
enum class Weights { none, gentle, hiding };
std::vector<WeightedPoint3> weighted_samples(const TriMesh& mesh, std::size_t n, Weights kind,
                                             std::uint64_t seed) {
  Rng rng(seed);
  std::vector<WeightedPoint3> result;
  const double spacing2 = mesh.area() / static_cast<double>(n);
  for (const fpo::SurfaceSample& s : fpo::random_samples(mesh, n, seed)) {
    const double scale = kind == Weights::none ? 0 : kind == Weights::gentle ? 0.3 : 8;
    result.push_back({s.position, scale * spacing2 * rng.uniform()});
  }
  return result;
}

/// Every registered circle is empty, and those of a kind that should be registered are.
void check_circles(const Diagram& d) {
  for (const CircleId c : d.circles) {
    const EmptyCircle& circle = d.power.circle(c);
    const double scale = d.power.mesh().diagonal() * d.power.mesh().diagonal();
    for (const SiteId s : d.present)
      CHECK(power(circle.center, d.sites[s]) >= circle.radius2 - 1e-12 * scale);
    for (const SiteId s : circle.sites)
      if (s.valid())
        CHECK(power(circle.center, d.sites[s]) == doctest::Approx(circle.radius2).epsilon(1e-9).scale(scale));
  }
}

/// Random insertions and removals, compared with the oracle after each.
void run_moves(const fixtures::NamedSurface& surface, bool search, CornerTypes types, Weights kind,
               int moves) {
  CAPTURE(surface.name);
  CAPTURE(search);
  CAPTURE(static_cast<int>(kind));
  constexpr std::size_t n = 24;
  Diagram d(surface.mesh, search, types);
  Rng rng(7);
  const std::vector<WeightedPoint3> pool = weighted_samples(surface.mesh, 400, kind, 3);
  for (int move = 0; move < moves; ++move) {
    const SiteId p(static_cast<std::size_t>(rng.below(n)));
    if (d.present.contains(p))
      d.remove(p);
    else
      d.insert(p, pool[rng.below(pool.size())]);
    d.power.check();
    const bool same =
        d.power.canonical() == oracle::restricted_power_diagram(surface.mesh, d.sites, d.present_list());
    REQUIRE_MESSAGE(same, "move " << move);
    if (!d.present.empty()) CHECK(total_area(d.power) == doctest::Approx(surface.mesh.area()).epsilon(1e-9));
    check_circles(d);
  }
}

}  // namespace

TEST_CASE("restricted power diagram: equals brute force after every move") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    const int moves = surface.mesh.num_facets() > 100 ? 40 : 160;
    for (const Weights kind : {Weights::none, Weights::gentle, Weights::hiding})
      for (const bool search : {true, false})
        run_moves(surface, search, kind == Weights::none ? CornerTypes::c_only : CornerTypes::all, kind,
                  moves);
  }
}

TEST_CASE("restricted power diagram: sites on a lattice, on edges, on vertices and twice at one place") {
  for (const bool search : {true, false}) {
    const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 2);
    Diagram d(cube, search, CornerTypes::all);
    Rng rng(5);
    std::vector<WeightedPoint3> pool;  // multiples of 1/4 on the surface: all kinds of ties
    for (int x = 0; x <= 4; ++x)
      for (int y = 0; y <= 4; ++y)
        for (const int z : {0, 4}) {
          pool.push_back({Vec3(x, y, z) / 4, 0});
          pool.push_back({Vec3(z, x, y) / 4, 0});
          pool.push_back({Vec3(y, z, x) / 4, 0.0625});
        }
    for (int move = 0; move < 150; ++move) {
      const SiteId p(static_cast<std::size_t>(rng.below(16)));
      if (d.present.contains(p))
        d.remove(p);
      else
        d.insert(p, pool[rng.below(pool.size())]);
      d.power.check();
      const bool same =
          d.power.canonical() == oracle::restricted_power_diagram(cube, d.sites, d.present_list());
      REQUIRE_MESSAGE(same, "move " << move << " search " << search);
    }
  }
}

TEST_CASE("restricted power diagram: moves at once between places of a lattice, with ties of all kinds") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 2), plate = fixtures::box(Vec3(1, 1, 0.125), 2);
  for (const TriMesh* const mesh : {&cube, &plate})
    for (const bool search : {true, false}) {
      Diagram d(*mesh, search, CornerTypes::c_only);
      Rng rng(13);
      std::vector<WeightedPoint3> pool;
      for (int x = 0; x <= 4; ++x)
        for (int y = 0; y <= 4; ++y)
          for (const double z : {0.0, mesh->box().max().z()})
            pool.push_back({Vec3(x / 4.0, y / 4.0, z), 0.03125 * (x == y)});
      for (std::size_t i = 0; i < 14; ++i) d.insert(SiteId(i), pool[rng.below(pool.size())]);
      for (int move = 0; move < 200; ++move) {
        const SiteId p(static_cast<std::size_t>(rng.below(14)));
        const WeightedPoint3 point = pool[rng.below(pool.size())];
        if (!d.move(p, point)) {
          d.remove(p);
          d.insert(p, point);
        }
        d.power.check();
        const bool same =
            d.power.canonical() == oracle::restricted_power_diagram(*mesh, d.sites, d.present_list());
        REQUIRE_MESSAGE(same, "move " << move << " search " << search);
      }
    }
}

TEST_CASE("restricted power diagram: remove and put back is the identity") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const bool search : {true, false}) {
      CAPTURE(surface.name);
      CAPTURE(search);
      Diagram d(surface.mesh, search, CornerTypes::c_only);
      const std::vector<WeightedPoint3> samples = weighted_samples(surface.mesh, 120, Weights::gentle, 11);
      for (std::size_t i = 0; i < samples.size(); ++i) d.insert(SiteId(i), samples[i]);
      const auto before = d.power.canonical();
      for (std::size_t i = 0; i < samples.size(); ++i) {
        d.remove(SiteId(i));
        d.insert(SiteId(i), samples[i]);
        if (i % 10 == 0) REQUIRE(d.power.canonical() == before);
      }
      REQUIRE(d.power.canonical() == before);
    }
}

TEST_CASE("restricted power diagram: local updates equal a rebuild after each of thousands of moves") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    constexpr std::size_t n = 60;
    Diagram d(surface.mesh, true, CornerTypes::c_only);
    Rng rng(23);
    const std::vector<WeightedPoint3> pool = weighted_samples(surface.mesh, 1000, Weights::gentle, 17);
    for (std::size_t i = 0; i < n; ++i) d.insert(SiteId(i), pool[i]);
    bool same = true;
    for (int move = 0; move < 500 && same; ++move) {
      const SiteId p(static_cast<std::size_t>(rng.below(n)));
      d.remove(p);
      d.insert(p, pool[rng.below(pool.size())]);
      Diagram fresh(surface.mesh, true, CornerTypes::c_only);
      for (std::size_t i = n; i > 0; --i) fresh.insert(SiteId(i - 1), d.sites[SiteId(i - 1)]);
      same = fresh.power.canonical() == d.power.canonical() && fresh.circles.size() == d.circles.size();
      CHECK_MESSAGE(same, "move " << move);
    }
  }
}

namespace {

/// All that a diagram tells of its circles, in an order that does not depend on history.
std::vector<std::tuple<FacetId, std::int32_t, std::array<SiteId, 3>, double, double, double, double>>
told_circles(const Diagram& d) {
  std::vector<std::tuple<FacetId, std::int32_t, std::array<SiteId, 3>, double, double, double, double>> all;
  for (const CircleId id : d.circles) {
    const EmptyCircle& c = d.power.circle(id);
    all.emplace_back(c.facet, c.place, c.sites, c.center.x(), c.center.y(), c.center.z(), c.radius2);
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace

// Small steps keep most edges, large ones few, and steps to a circle of the plan are what the optimization makes.
TEST_CASE("restricted power diagram: a move at once is a removal and an insertion") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights kind : {Weights::none, Weights::gentle, Weights::hiding})
      for (const bool search : {true, false}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(kind));
        CAPTURE(search);
        const std::size_t n = search ? 40 : 6;  // 6: many facets have but one neighbour of the cell
        Diagram at_once(surface.mesh, search, CornerTypes::c_only),
            in_steps(surface.mesh, search, CornerTypes::c_only);
        const std::vector<WeightedPoint3> pool = weighted_samples(surface.mesh, 400, kind, 31);
        for (std::size_t i = 0; i < n; ++i)
          at_once.insert(SiteId(i), pool[i]), in_steps.insert(SiteId(i), pool[i]);
        Rng rng(3);
        for (int move = 0; move < 120; ++move) {
          CAPTURE(move);
          const SiteId p(static_cast<std::size_t>(rng.below(n)));
          WeightedPoint3 point = pool[rng.below(pool.size())];
          if (move % 3 != 0) {
            std::vector<Vec3> centers;
            for (CircleId c = in_steps.power.first_circle(p); c.valid(); c = in_steps.power.next_circle(c, p))
              centers.push_back(in_steps.power.circle(c).center);
            const Vec3 old = in_steps.sites[p].position;
            const double step = move % 3 == 1 ? 0.01 : 1;
            if (!centers.empty()) point.position = old + step * (centers[rng.below(centers.size())] - old);
            if (step < 1) point.weight = in_steps.sites[p].weight;
          }
          if (move % 20 == 19) point = in_steps.sites[p];  // stays
          if (!at_once.move(p, point)) {
            at_once.remove(p);
            at_once.insert(p, point);
          }
          in_steps.remove(p);
          in_steps.insert(p, point);
          at_once.power.check();
          REQUIRE(at_once.power.canonical() == in_steps.power.canonical());
          REQUIRE(told_circles(at_once) == told_circles(in_steps));
          for (std::size_t i = 0; i < n; ++i)  // bounds
            if (!at_once.power.fragments().of_cell(SiteId(i)).empty())
              REQUIRE(at_once.power.reach(SiteId(i)) <= in_steps.power.reach(SiteId(i)));
        }
        REQUIRE(at_once.power.canonical() ==
                oracle::restricted_power_diagram(surface.mesh, at_once.sites, at_once.present_list()));
      }
}

TEST_CASE("restricted power diagram: a plan tells the circles of the removal and changes nothing") {
  int incomplete = 0;
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights kind : {Weights::none, Weights::gentle}) {
      CAPTURE(surface.name);
      Diagram d(surface.mesh, true, CornerTypes::c_only);
      const std::vector<WeightedPoint3> samples =
          weighted_samples(surface.mesh, kind == Weights::none ? 60 : 9, kind, 37);
      for (std::size_t i = 0; i < samples.size(); ++i) d.insert(SiteId(i), samples[i]);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const SiteId p(i);
        const auto before = d.power.canonical();
        d.source->remove(p);
        using Circles = std::set<std::tuple<double, FacetId, std::array<SiteId, 3>>>;
        const auto circles_of = [](const RestrictedPower::Plan& plan) {
          Circles circles;
          for (const EmptyCircle& c : plan.circles) {
            circles.emplace(c.radius2, c.facet, c.sites);
            CHECK(c.radius2 <= plan.max_radius2);
          }
          return circles;
        };
        const std::optional<RestrictedPower::Plan> plan = d.power.plan_removal(p);
        REQUIRE(d.power.canonical() == before);
        Circles partial, planned, created;
        if (plan) partial = circles_of(*plan);
        incomplete += plan && !plan->is_complete();
        if (plan && i % 2 == 0) planned = circles_of(d.power.complete_plan(p));
        const RestrictedPower::Change& change = plan ? d.power.carry_out_removal(p) : d.power.after_remove(p);
        for (const CircleId c : change.circles_created)
          created.emplace(d.power.circle(c).radius2, d.power.circle(c).facet, d.power.circle(c).sites);
        if (plan && i % 2 == 0) REQUIRE(planned == created);
        if (plan) {
          REQUIRE(std::ranges::includes(created, partial));
          for (const auto& circle : created)
            if (std::get<double>(circle) > plan->complete_above) REQUIRE(partial.contains(circle));
        }
        d.apply(change);
        d.present.erase(p);
        d.power.check();
        d.insert(p, samples[i]);
      }
    }
  CHECK(incomplete > 0);
}

TEST_CASE("restricted power diagram: the owner of a fragment is the nearest site at its middle") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    Diagram d(surface.mesh, true, CornerTypes::c_only);
    const std::vector<WeightedPoint3> samples = weighted_samples(surface.mesh, 200, Weights::gentle, 29);
    for (std::size_t i = 0; i < samples.size(); ++i) d.insert(SiteId(i), samples[i]);
    const std::vector<SiteId> present = d.present_list();
    std::array<PolygonCorner, 3> buffer;
    for (FacetId t(0); t.index() < surface.mesh.num_facets(); t = FacetId(t.value + 1))
      for (const FragmentId f : d.power.fragments().of_facet(t)) {
        const auto corners = d.power.fragments().corners(f, buffer);
        Vec3 middle(0, 0, 0);
        for (const PolygonCorner& c : corners)
          middle += c.point.position / static_cast<double>(corners.size());
        const SiteId nearest = oracle::nearest(middle, d.sites, present);
        CHECK(power(middle, d.sites[d.power.fragments().site(f)]) <= power(middle, d.sites[nearest]) + 1e-13);
      }
  }
}
