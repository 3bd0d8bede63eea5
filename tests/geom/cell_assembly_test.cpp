// The assembled cell against the same cell clipped from the facets.

#include "geom/cell_assembly.h"

#include <algorithm>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;

namespace {

/// Sites about the corners of the mesh; many cells are cut by others, some facets hold several.
Clipper::Sites draw_sites(const TriMesh& mesh, std::size_t n, double scatter, Rng& rng) {
  Clipper::Sites sites;
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 x = mesh.position(VertexId(static_cast<std::size_t>(rng.below(mesh.num_vertices()))));
    for (int k = 0; k < 3; ++k) x[k] += rng.uniform(-scatter, scatter);
    sites.push_back({x, scatter * scatter * rng.uniform(-0.5, 0.5)});
  }
  return sites;
}

double extent_of(const TriMesh& mesh, const Clipper::Sites& sites) {
  double extent =
      std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
  for (const WeightedPoint3& s : sites) extent = std::max(extent, s.position.lpNorm<Eigen::Infinity>());
  return extent;
}

/// The polygon of a site on a facet, one other left out; empty if it has none.
FacetPolygon cell_on(Clipper& clipper, std::size_t num_sites, FacetId t, SiteId owner, SiteId without) {
  FacetPolygon polygon;
  clipper.start(polygon, t, owner);
  for (std::size_t j = 0; j < num_sites && !polygon.corners.empty(); ++j)
    if (SiteId(j) != owner && SiteId(j) != without)
      if (clipper.clip(polygon, SiteId(j)) == Clip::swallowed) polygon.corners.clear();
  return polygon;
}

void start_at_smallest_edge(FacetPolygon& polygon) {
  const auto smallest = std::ranges::min_element(polygon.corners, {}, &PolygonCorner::edge);
  std::rotate(polygon.corners.begin(), smallest, polygon.corners.end());
}

}  // namespace

TEST_CASE("cell assembly: the edges taken from the rivals close to the new cell, corner by corner") {
  Rng rng(5);
  std::size_t outlines = 0, with_facet_edges = 0, whole = 0;
  for (const auto& [name, mesh] : fixtures::surfaces()) {
    if (mesh.num_facets() > 400) continue;
    CAPTURE(name);
    for (const double scatter : {0.05, 0.3}) {
      const std::size_t n = 12;
      const Clipper::Sites sites = draw_sites(mesh, n, scatter, rng);
      Clipper clipper(mesh, sites, extent_of(mesh, sites));
      CellAssembly assembly(mesh, clipper);
      std::vector<char> beaten;
      for (SiteId p(0); p.index() < n; p = SiteId(p.value + 1)) {
        for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
          for (SiteId j(0); j.index() < n; j = SiteId(j.value + 1)) {
            if (j == p) continue;
            const FacetPolygon old = cell_on(clipper, n, t, j, p);
            if (old.corners.empty()) continue;
            const Bisector b = clipper.bisector_of(j, p);
            const Clip outcome = clipper.classify(t, j, old.corners, p, b, beaten);
            if (outcome == Clip::swallowed) assembly.win_on(t);
            if (outcome != Clip::cut) continue;
            const CutPlace place = Clipper::place_of_cut(old.corners, beaten);
            assembly.add_cut(t, {.rival = j, .leaving = place.leaving, .entering = place.entering}, p, b);
          }
        std::size_t facets_won = 0;
        for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
          facets_won += !cell_on(clipper, n, t, p, SiteId()).corners.empty();
        CHECK(assembly.facets().size() == facets_won);
        for (const CellAssembly::TouchedFacet& touched : assembly.facets()) {
          FacetPolygon now, expected = cell_on(clipper, n, touched.facet, p, SiteId());
          assembly.assemble(touched, p, now);
          CHECK(now.owner == p);
          REQUIRE(now.corners.size() == expected.corners.size());
          start_at_smallest_edge(now);
          start_at_smallest_edge(expected);
          for (std::size_t k = 0; k < now.corners.size(); ++k) {
            CHECK(now.corners[k].edge == expected.corners[k].edge);
            CHECK(now.corners[k].point.position == expected.corners[k].point.position);
          }
          ++outlines;
          whole += touched.cuts < 0;
          with_facet_edges +=
              touched.cuts >= 0 &&
              std::ranges::any_of(now.corners, [](const PolygonCorner& c) { return !c.edge.is_site(); });
        }
        assembly.clear();
        CHECK(assembly.facets().empty());
      }
    }
  }
  CHECK(outlines > 1000);
  CHECK(with_facet_edges > 100);
  CHECK(whole > 100);
}

TEST_CASE("cell assembly: edges that do not close are a bug") {
  const TriMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                     {TriMesh::Facet{VertexId(0), VertexId(1), VertexId(2)}});
  const Vec3 middle(0.3, 0.3, 0);  // is as far from all three
  Clipper::Sites sites;
  for (const Vec3& d : {Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(-0.1, 0, 0)}) sites.push_back({middle + d, 0});
  const SiteId j(0), k(1), p(2);
  const Clipper clipper(mesh, sites, 1);
  CellAssembly assembly(mesh, clipper);
  const EdgeLabel edge = EdgeLabel::bisector(k);
  const auto ends = assembly.add_cut(FacetId(0), {.rival = j, .leaving = edge, .entering = edge}, p,
                                     clipper.bisector_of(j, p));
  CHECK((ends[0].position - middle).norm() < 1e-12);
  CHECK(assembly.touch(FacetId(0)).won);
  FacetPolygon polygon;
  CHECK_THROWS_AS(assembly.assemble(assembly.facets().front(), p, polygon), Bug);  // k was not cut
}
