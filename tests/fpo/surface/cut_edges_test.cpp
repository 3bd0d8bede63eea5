#include "fpo/surface/cut_edges.h"

#include <random>
#include <vector>

#include "doctest.h"
#include "fpo/features/features.h"
#include "fpo/features/split_features.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// So many, on any edges, some more than once.
std::vector<EdgeCut> random_cuts(const TriMesh& mesh, std::size_t number) {
  std::mt19937_64 random(7);
  std::vector<EdgeCut> cuts;
  while (cuts.size() < number) {
    const TriMesh::Facet& f = mesh.facet(FacetId(random() % mesh.num_facets()));
    const std::size_t e = random() % 3;
    for (std::uint64_t times = 1 + random() % 3; times > 0; --times)
      cuts.push_back({{f[e], f[(e + 1) % 3]}, static_cast<double>(1 + random() % 98) / 99});
  }
  return cuts;
}

}  // namespace

TEST_CASE("cut edges: the same surface, facet by facet, and its old vertices") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const SplitSurface cut = with_cut_edges(mesh, random_cuts(mesh, 40));
    CHECK(cut.mesh.num_vertices() > mesh.num_vertices() + 10);
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
      CHECK(cut.mesh.position(v) == mesh.position(v));
    const geom::Topology was = geom::topology(mesh), is = geom::topology(cut.mesh);
    CHECK(is.euler == was.euler);
    CHECK(is.components == was.components);
    CHECK(is.boundary_loops == was.boundary_loops);
    CHECK(is.nonmanifold_edges >= was.nonmanifold_edges);  // some are cut
    CHECK(is.misoriented_edges >= was.misoriented_edges);
    std::vector<double> areas(mesh.num_facets(), 0);
    for (FacetId t(0); t.index() < cut.mesh.num_facets(); t = FacetId(t.value + 1)) {
      areas[cut.parents[t].index()] += cut.mesh.area(t);
      CHECK(cut.mesh.normal(t).dot(mesh.normal(cut.parents[t])) >= 0);
    }
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      CHECK(areas[t.index()] == doctest::Approx(mesh.area(t)).epsilon(1e-9));
  }
}

TEST_CASE("cut edges: where they are asked for, once, from either end; not what is no edge") {
  const TriMesh mesh = fixtures::block(8, 4, 2);
  const Features features = find_features(mesh);
  const auto ends = [&](std::size_t c) {
    return std::array{features.curves[c].vertices.front(), features.curves[c].vertices.back()};
  };
  const auto [a, b] = ends(0);
  const std::vector<EdgeCut> cuts{{{a, b}, 0.25}, {{b, a}, 0.75}, {{b, a}, 0.5}, {{a, a}, 0.5}};
  const SplitSurface cut = with_cut_edges(mesh, cuts);
  REQUIRE(cut.mesh.num_vertices() == mesh.num_vertices() + 2);
  CHECK(cut.mesh.num_facets() == mesh.num_facets() + 4);
  const Vec3 &x = mesh.position(a), &y = mesh.position(b);
  std::vector<Vec3> expected{Vec3(0.75 * x + 0.25 * y), Vec3(0.5 * x + 0.5 * y)};
  if (b < a) std::swap(expected[0], expected[1]);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(cut.mesh.position(VertexId(mesh.num_vertices() + i)) == expected[i]);
  const Features now = split_features(features, mesh, cut);
  CHECK(now.curves[0].vertices.size() == 4);
  CHECK(now.curves[1].vertices.size() == 2);
  CHECK(with_cut_edges(mesh, {}).mesh.facets() == mesh.facets());
}
