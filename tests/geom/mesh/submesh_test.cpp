#include "geom/mesh/submesh.h"

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;

TEST_CASE("submesh: corners, neighbours, box and order of ids are those of the whole") {
  Rng rng(3);
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& whole = surface.mesh;
    const double share = rng.below(2) == 0 ? 0.67 : 0.02;  // so that ids are dense, and not
    std::vector<FacetId> chosen;
    for (std::size_t t = 0; t < whole.num_facets(); ++t)
      if (rng.uniform() < share) chosen.emplace_back(t);
    const Submesh part = submesh(whole, chosen);
    REQUIRE(part.facets == chosen);
    REQUIRE(part.mesh.num_facets() == chosen.size());
    CHECK(part.mesh.box().isApprox(whole.box(), 0));
    CHECK(std::ranges::is_sorted(part.vertices));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const FacetId here(i), there = chosen[i];
      CHECK(part.here(there) == here);
      for (int k = 0; k < 3; ++k) {
        const VertexId v = part.mesh.facet(here)[static_cast<std::size_t>(k)];
        CHECK(part.vertices[v.index()] == whole.facet(there)[static_cast<std::size_t>(k)]);
        CHECK(part.mesh.corner(here, k) == whole.corner(there, k));
        const FacetId across = whole.across(there, k);
        const bool kept = std::ranges::find(chosen, across) != chosen.end();
        CHECK(part.mesh.across(here, k) == (kept ? part.here(across) : FacetId()));
      }
    }
  }
}
