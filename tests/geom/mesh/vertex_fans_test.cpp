#include "geom/mesh/vertex_fans.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/connections.h"

namespace {

using fixtures::connections;
using geom::FacetId;
using geom::TriMesh;
using geom::VertexFans;
using geom::VertexId;

/// By the definition: the facets of v, joined if they share an edge at v that no third one has.
void check_against_definition(const TriMesh& mesh) {
  const VertexFans fans(mesh);
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1)) {
    std::vector<FacetId> facets;
    std::map<VertexId, std::vector<FacetId>> at;  // by the other end of an edge
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
      if (std::ranges::find(mesh.facet(t), v) == mesh.facet(t).end()) continue;
      facets.push_back(t);
      for (const VertexId w : mesh.facet(t))
        if (w != v) at[w].push_back(t);
    }
    REQUIRE(fans.num_facets(v) == facets.size());
    if (facets.empty()) {
      CHECK(fans.is_manifold(v));
      continue;
    }
    std::set<FacetId> reached{facets[0]};
    for (std::size_t before = 0; before < reached.size();) {
      before = reached.size();
      for (const auto& [w, of] : at)
        if (of.size() == 2 && (reached.contains(of[0]) || reached.contains(of[1])))
          reached.insert(of.begin(), of.end());
    }
    const bool is_whole = reached.size() == facets.size();
    CHECK(fans.at(v).is_whole == is_whole);
    CHECK(fans.is_manifold(v) == is_whole);
    if (!is_whole) continue;
    CHECK(std::ranges::all_of(at, [](const auto& edge) { return edge.second.size() <= 2; }));
    std::set<std::set<VertexId>> different;
    for (const FacetId t : facets) different.insert({mesh.facet(t).begin(), mesh.facet(t).end()});
    CHECK(fans.at(v).is_doubled == (different.size() < facets.size()));
  }
}

}  // namespace

TEST_CASE("vertex fans: of every shape each vertex is one fan or one disk") {
  for (const geom::ShapeInfo& info : geom::shape_table()) {
    CAPTURE(std::string(info.name));
    const TriMesh mesh = geom::make_shape(info.name, info.name == "double-torus" ? 12 : 3);
    const VertexFans fans(mesh);
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1)) {
      CHECK(fans.is_manifold(v));
      CHECK(!fans.at(v).is_doubled);
    }
  }
}

TEST_CASE("vertex fans: doubled facets, pinches, edges of three facets") {
  check_against_definition(connections(3, {{0, 1, 2}, {0, 2, 1}}));                        // a pillow
  check_against_definition(connections(4, {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));             // one too many
  check_against_definition(connections(5, {{0, 1, 2}, {0, 3, 4}}));                        // two fans
  check_against_definition(connections(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));             // a book
  check_against_definition(connections(4, {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}, {0, 3, 1}}));  // two pillows
}

TEST_CASE("vertex fans: random facets among few vertices") {
  geom::Rng rng(5);
  for (int round = 0; round < 400; ++round) {
    const int num_vertices = 4 + static_cast<int>(rng.below(5));
    std::vector<std::array<int, 3>> triangles;
    for (std::size_t i = 1 + rng.below(14); i > 0; --i) {
      std::vector<int> all(static_cast<std::size_t>(num_vertices));
      for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
      rng.shuffle(std::span(all));
      triangles.push_back({all[0], all[1], all[2]});
    }
    check_against_definition(connections(static_cast<std::size_t>(num_vertices), triangles));
  }
}
