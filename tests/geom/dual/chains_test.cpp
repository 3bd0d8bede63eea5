#include "geom/dual/chains.h"

#include <algorithm>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/power/facet_cells.h"
#include "geom/rng.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::Weights;

namespace {

VertexId v(int i) { return VertexId(i); }

/// A state with its circles, which chains have joined in a certain order of facets.
struct Joined {
  Joined(const TriMesh& mesh, const std::vector<fixtures::Placed>& samples, CornerTypes types,
         std::span<const FacetId> order)
      : state(mesh, types, nullptr), chains(state) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      state.admit(SiteId(i), samples[i].point);
      state.search.enter(SiteId(i));
      present.emplace_back(i);
    }
    const DividedSurface surface{mesh, state.sites, state.clipper, state.search.tree()};
    surface.for_each(order, 1, [&](FacetId t, std::span<const FacetPiece> pieces) {
      EmptyCircle circle;
      for (const auto& [owner, corners] : pieces)
        for (std::size_t k = 0; k < corners.size(); ++k)
          if (state.corners.find({t, owner, corners}, k, circle)) state.circles.create(circle);
      chains.add(t, pieces);
    });
  }
  std::vector<oracle::KnownCircle> known() const {
    std::vector<oracle::KnownCircle> result;
    const auto name_of = [&](CircleId id) {
      if (!id.valid()) return oracle::no_circle;
      return oracle::CircleName{state.circles[id].facet, state.circles[id].place, state.circles[id].sites};
    };
    for (const SiteId s : present)
      for (const CircleId id : state.circles.of_site(s)) {
        const EmptyCircle& c = state.circles[id];
        if (c.sites[0] != s) continue;
        oracle::KnownCircle known{
            name_of(id), c.clockwise, {c.center.x(), c.center.y(), c.center.z()}, c.radius2, {}};
        for (std::size_t i = 0; i < 3; ++i) known.beyond[i] = name_of(c.beyond[i]);
        result.push_back(known);
      }
    std::ranges::sort(result);
    return result;
  }
  DualState state;
  EdgeChains chains;
  std::vector<SiteId> present;
};

/// The pairs of sites between which there is an edge of the diagram without a circle at either end.
std::set<std::pair<SiteId, SiteId>> edges_without_circle(const TriMesh& mesh,
                                                         const oracle::BruteDiagram& brute) {
  // The segments of each pair, by facet; joined across edges of the surface.
  std::set<std::pair<SiteId, SiteId>> result;
  std::map<std::pair<SiteId, SiteId>, std::set<FacetId>> segments;
  for (const auto& [key, polygon] : brute.polygons())
    for (const PolygonCorner& c : polygon.corners)
      if (c.edge.is_site() && polygon.owner < c.edge.site())
        segments[{polygon.owner, c.edge.site()}].insert(polygon.facet);
  for (auto& [pair, facets] : segments)
    while (!facets.empty()) {
      std::vector<FacetId> stack{*facets.begin()};
      facets.erase(facets.begin());
      bool has_circle = false;
      while (!stack.empty()) {
        const FacetId t = stack.back();
        stack.pop_back();
        const FacetPolygon& polygon = brute.polygons().at({t, pair.first});
        const std::size_t n = polygon.corners.size();
        for (std::size_t k = 0; k < n; ++k) {
          if (polygon.corners[k].edge != EdgeLabel::bisector(pair.second)) continue;
          for (const EdgeLabel end : {polygon.edge_before(k), polygon.corners[next_corner(k, n)].edge}) {
            has_circle |= end.is_site();
            if (end.is_site()) continue;
            const auto across = facets.find(mesh.across(t, end.edge()));
            if (across == facets.end()) continue;
            stack.push_back(*across);
            facets.erase(across);
          }
        }
      }
      if (!has_circle) result.insert(pair);
    }
  return result;
}

}  // namespace

TEST_CASE("edge chains: the circles beyond are those at the other ends of edges, facets in any order") {
  std::size_t lone = 0, circles = 0;
  std::vector<fixtures::NamedSurface> all = fixtures::hard_surfaces();
  for (fixtures::NamedSurface& s : fixtures::surfaces()) all.push_back(std::move(s));
  for (const auto& surface : all)
    for (const Weights weights : fixtures::all_weights)
      for (const std::size_t n : {4u, 40u}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        CAPTURE(n);
        const std::vector<fixtures::Placed> samples =
            fixtures::placed_samples(surface.mesh, n, n, weights, 14);
        std::vector<FacetId> order = facets_along_curve(surface.mesh);
        const CornerTypes types = n == 4 ? CornerTypes::c_only : CornerTypes::all;
        const Joined along(surface.mesh, samples, types, order);
        Rng(n).shuffle(std::span(order));
        const Joined shuffled(surface.mesh, samples, types, order);
        const oracle::BruteDiagram brute(surface.mesh, along.state.sites, along.present);
        const std::vector<oracle::KnownCircle> expected = brute.dual(types).circles;
        CHECK(along.known() == expected);
        CHECK(shuffled.known() == expected);
        CHECK_NOTHROW(along.state.circles.check());
        circles += expected.size();
        // An edge of three facets, and a facet that has no area, end a chain or begin it in places of their
        // own.
        std::set<SiteId> sites;
        for (const auto& [a, b] : edges_without_circle(surface.mesh, brute)) sites.insert({a, b});
        for (const Joined* joined : {&along, &shuffled}) {
          const std::span<const SiteId> told = joined->chains.without_circle();
          CHECK(std::set<SiteId>(told.begin(), told.end()) == sites);
        }
        lone += sites.size();
      }
  CHECK(circles > 1000);
  CHECK(lone > 100);
}

TEST_CASE("edge chains: the same edge of two facets, whichever way they run, and when they share several") {
  // Two triangles back to back: they share all edges.
  const TriMesh pillow({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                       {{v(0), v(1), v(2)}, {v(1), v(0), v(2)}});
  for (int e = 0; e < 3; ++e) {
    const int f = same_edge(pillow, FacetId(0), e, FacetId(1));
    REQUIRE(f >= 0);
    const TriMesh::Facet &a = pillow.facet(FacetId(0)), &b = pillow.facet(FacetId(1));
    const auto at = [](const TriMesh::Facet& facet, int i) { return facet[static_cast<std::size_t>(i % 3)]; };
    CHECK(std::minmax({at(a, e), at(a, e + 1)}) == std::minmax({at(b, f), at(b, f + 1)}));
    CHECK(same_edge(pillow, FacetId(1), f, FacetId(0)) == e);
  }
  for (const bool turned : {false, true}) {
    const TriMesh pair(
        {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)},
        {{v(0), v(1), v(2)}, turned ? TriMesh::Facet{v(1), v(2), v(3)} : TriMesh::Facet{v(2), v(1), v(3)}});
    CHECK(same_edge(pair, FacetId(0), 1, FacetId(1)) == 0);
    CHECK(same_edge(pair, FacetId(0), 0, FacetId(1)) == -1);
    CHECK(same_edge(pair, FacetId(0), 2, FacetId(1)) == -1);
  }
  // Three facets at an edge: nobody is across.
  const TriMesh three({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)},
                      {{v(0), v(1), v(2)}, {v(1), v(0), v(3)}, {v(0), v(1), v(4)}});
  CHECK(same_edge(three, FacetId(0), 0, FacetId(1)) == -1);
}
