#include "fpo/remesh/return_to.h"

#include <memory>

#include "doctest.h"
#include "fpo/surface/cut_edges.h"
#include "tests/fixtures/block.h"

using namespace fpo;
using geom::FacetId;

TEST_CASE(
    "return to: samples, cells and sizes become those of the surface, of what there is instead as well") {
  const geom::TriMesh surface = fixtures::block(4, 4, 4);
  const EdgeCut edge{{surface.facet(FacetId(0))[0], surface.facet(FacetId(0))[1]}, 0.5};
  const auto cut = std::make_shared<const SplitSurface>(with_cut_edges(surface, {&edge, 1}));
  REQUIRE(cut->mesh.num_facets() > surface.num_facets());
  RemeshResult result;
  result.sizing.resize(cut->mesh.num_vertices(), 1);
  for (FacetId t(0); t.index() < cut->mesh.num_facets(); t = FacetId(t.value + 1)) {
    result.samples.push_back({cut->mesh.corner(t, 0), t});
    result.cells.push_back({geom::SiteId(0), t, {}});
  }
  result.last_resort = std::make_shared<const RemeshResult>(result);
  return_to(surface, cut, result);
  CHECK(result.cut == cut);
  for (const RemeshResult* of : {&std::as_const(result), result.last_resort.get()}) {
    CHECK(of->sizing.size() == surface.num_vertices());
    for (std::size_t i = 0; i < of->samples.size(); ++i) {
      CHECK(of->samples[i].facet == cut->parents[FacetId(i)]);
      CHECK(of->cells[i].facet == cut->parents[FacetId(i)]);
    }
  }
}
