// One cell by itself against all polygons of divided facets.

#include "geom/dual/cell_clipper.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "doctest.h"
#include "geom/power/facet_cells.h"
#include "geom/rng.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/placed_samples.h"

using namespace geom;
using fixtures::Weights;

namespace {

std::vector<EdgeLabel> labels_of(std::span<const PolygonCorner> corners) {
  std::vector<EdgeLabel> labels;
  for (const PolygonCorner& c : corners) labels.push_back(c.edge);
  std::rotate(labels.begin(), std::ranges::min_element(labels), labels.end());
  return labels;
}

}  // namespace

TEST_CASE(
    "cell clipper: a cell has the polygons of the divided facets, whoever is said to be around, each by "
    "itself") {
  std::vector<fixtures::NamedSurface> all = fixtures::hard_surfaces();
  for (fixtures::NamedSurface& s : fixtures::surfaces()) all.push_back(std::move(s));
  for (const auto& surface : all)
    for (const Weights weights : fixtures::all_weights) {
      CAPTURE(surface.name);
      CAPTURE(static_cast<int>(weights));
      constexpr std::size_t n = 60;
      DualState state(surface.mesh, CornerTypes::c_only, nullptr);
      const std::vector<fixtures::Placed> samples = fixtures::placed_samples(surface.mesh, n, n, weights, 4);
      for (std::size_t i = 0; i < n; ++i) {
        state.admit(SiteId(i), samples[i].point);
        state.search.enter(SiteId(i));
      }
      FacetCells facets(surface.mesh, state.sites, state.clipper, state.search.tree());
      std::vector<std::vector<FacetPolygon>> expected(n);
      for (FacetId t(0); t.index() < surface.mesh.num_facets(); t = FacetId(t.value + 1))
        for (const FacetPolygon& polygon : facets.divide(t))
          expected[polygon.owner.index()].push_back(polygon);
      CellClipper clipper(state);
      CellPieces cell;
      Rng rng(5);
      for (std::size_t i = 0; i < n; ++i) {
        double reach = -std::numeric_limits<double>::infinity();
        for (const FacetPolygon& polygon : expected[i])
          reach = std::max(reach, state.clipper.bound_power(polygon));
        std::vector<SiteId> around;
        for (std::size_t k = 0; k < i % 5; ++k) {
          const SiteId s(static_cast<std::size_t>(rng.below(n)));
          if (s != SiteId(i) && std::ranges::find(around, s) == around.end()) around.push_back(s);
        }
        CHECK(clipper.clip(SiteId(i), reach + (i % 3 == 0 ? 1 : 0), around, cell) == reach);
        state.reach.set(SiteId(i), reach);
        for (int k = 0; k < 20; ++k) {
          const FacetId t(static_cast<std::size_t>(rng.below(surface.mesh.num_facets())));
          CHECK(clipper.has_part_of(t, SiteId(i)) ==
                std::ranges::any_of(expected[i], [&](const FacetPolygon& f) { return f.facet == t; }));
        }
        for (const FacetPolygon& polygon : expected[i]) CHECK(clipper.has_part_of(polygon.facet, SiteId(i)));
        REQUIRE(cell.pieces.size() == expected[i].size());
        std::ranges::sort(cell.pieces, {}, &CellPieces::Piece::facet);
        for (std::size_t k = 0; k < cell.pieces.size(); ++k) {
          CHECK(cell.pieces[k].facet == expected[i][k].facet);
          CHECK(labels_of(cell.corners_of(cell.pieces[k])) == labels_of(expected[i][k].corners));
        }
      }
    }
}
