// The diagram built at once against the one that insertions lead to.

#include <memory>

#include "doctest.h"
#include "fpo/initial_samples.h"
#include "geom/restricted_power.h"
#include "geom/rng.h"
#include "geom/site_tree.h"
#include "geom/triangulation_source.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace geom;

namespace {

struct Diagram {
  Diagram(const TriMesh& mesh, CornerTypes types, bool search = true)
      : source(search ? std::unique_ptr<NeighbourSource>(new SiteTree)
                      : std::unique_ptr<NeighbourSource>(new TriangulationSource(mesh.box()))),
        power(mesh, *source, types) {}
  std::unique_ptr<NeighbourSource> source;
  RestrictedPower power;
};

std::unique_ptr<Diagram> inserted(const TriMesh& mesh, CornerTypes types,
                                  const std::vector<WeightedPoint3>& points) {
  auto d = std::make_unique<Diagram>(mesh, types);
  for (std::size_t i = 0; i < points.size(); ++i) {
    d->source->insert(SiteId(i), points[i], SiteId());
    d->power.after_insert(SiteId(i), points[i]);
  }
  return d;
}

std::unique_ptr<Diagram> built(const TriMesh& mesh, CornerTypes types,
                               const std::vector<WeightedPoint3>& points, int threads, bool search = true) {
  auto d = std::make_unique<Diagram>(mesh, types, search);
  SiteTree tree;
  for (std::size_t i = 0; i < points.size(); ++i) {
    d->source->insert(SiteId(i), points[i], SiteId());
    tree.insert(SiteId(i), points[i]);
  }
  d->power.build(points, tree, threads);
  return d;
}

std::vector<WeightedPoint3> weighted_samples(const TriMesh& mesh, std::size_t n, double share) {
  std::vector<WeightedPoint3> points;
  Rng rng(n);
  for (const fpo::SurfaceSample& s : fpo::random_samples(mesh, n, 9))
    points.push_back({s.position, share * rng.uniform() * mesh.area() / static_cast<double>(n)});
  return points;
}

/// Circles by value, ids left out.
auto circles_of(const RestrictedPower& power, std::size_t n) {
  std::vector<std::tuple<FacetId, int, std::array<SiteId, 3>, double, double, double, double>> all;
  for (SiteId s(0); s.index() < n; s = SiteId(s.value + 1))
    for (CircleId c = power.first_circle(s); c.valid(); c = power.next_circle(c, s)) {
      const EmptyCircle& e = power.circle(c);
      all.emplace_back(e.facet, e.place, e.sites, e.center.x(), e.center.y(), e.center.z(), e.radius2);
    }
  std::ranges::sort(all);
  return all;
}

/// To the bit, but for where the corners of a fragment begin.
bool same_fragments(const RestrictedPower& a, const RestrictedPower& b) {
  if (a.canonical() != b.canonical()) return false;
  std::array<PolygonCorner, 3> of_a, of_b;
  for (FacetId t(0); t.index() < a.mesh().num_facets(); t = FacetId(t.value + 1))
    for (const FragmentId f : a.fragments().of_facet(t)) {
      const FragmentId g = b.fragments().find(a.fragments().site(f), t);
      for (const PolygonCorner& c : a.fragments().corners(f, of_a)) {
        const auto corners = b.fragments().corners(g, of_b);
        const auto d = std::ranges::find(corners, c.edge, &PolygonCorner::edge);
        if (d->point.position != c.point.position || d->point.tolerance != c.point.tolerance) return false;
      }
    }
  return true;
}

}  // namespace

TEST_CASE("restricted power diagram: built at once, it is the one that insertions lead to") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const double share : {0.0, 0.3, 8.0})
      for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all})
        for (const std::size_t n : {1u, 3u, 60u, 500u}) {
          CAPTURE(surface.name);
          CAPTURE(share);
          CAPTURE(n);
          const std::vector<WeightedPoint3> points = weighted_samples(surface.mesh, n, share);
          const auto one_by_one = inserted(surface.mesh, types, points),
                     at_once = built(surface.mesh, types, points, 2);
          at_once->power.check();
          CHECK(same_fragments(one_by_one->power, at_once->power));
          CHECK(circles_of(one_by_one->power, n) == circles_of(at_once->power, n));
        }
}

TEST_CASE("restricted power diagram: built at once, it can be changed with either source") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const bool search : {true, false}) {
      CAPTURE(surface.name);
      CAPTURE(search);
      constexpr std::size_t n = 24;
      std::vector<WeightedPoint3> points = weighted_samples(surface.mesh, n, 0.3);
      const std::vector<WeightedPoint3> pool = weighted_samples(surface.mesh, 300, 8 * 300.0 / n);
      const auto d = built(surface.mesh, CornerTypes::all, points, 1, search);
      Clipper::Sites sites(points.begin(), points.end());
      std::vector<SiteId> present;
      for (std::size_t i = 0; i < n; ++i) present.emplace_back(i);
      Rng rng(3);
      for (int move = 0; move < 40; ++move) {
        const SiteId p(static_cast<std::size_t>(rng.below(n)));
        d->source->remove(p);
        d->power.after_remove(p);
        sites[p] = pool[rng.below(pool.size())];
        d->source->insert(p, sites[p], SiteId(p.value == 0 ? 1 : 0));
        d->power.after_insert(p, sites[p]);
        d->power.check();
        REQUIRE(d->power.canonical() == oracle::restricted_power_diagram(surface.mesh, sites, present));
      }
    }
}

TEST_CASE("restricted power diagram: built at once by any number of threads, it is laid out the same") {
  const TriMesh blob = fixtures::blob(20);
  const std::vector<WeightedPoint3> points = weighted_samples(blob, 3000, 0.3);
  const auto by_one = built(blob, CornerTypes::all, points, 1);
  for (const int threads : {2, 8}) {
    const auto by_many = built(blob, CornerTypes::all, points, threads);
    const FragmentStore &a = by_one->power.fragments(), &b = by_many->power.fragments();
    REQUIRE(a.size() == b.size());
    for (SiteId s(0); s.index() < points.size(); s = SiteId(s.value + 1)) {
      REQUIRE(std::ranges::equal(a.of_cell(s), b.of_cell(s)));
      for (const FragmentId f : a.of_cell(s))
        REQUIRE(std::ranges::equal(
            a.corners(f), b.corners(f), [](const PolygonCorner& c, const PolygonCorner& d) {
              return c.point.position == d.point.position && c.edge == d.edge && c.circle == d.circle;
            }));
    }
  }
}
