#include "fpo/remesh/defects.h"

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "tests/fixtures/book.h"

using namespace fpo;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

TriMesh mesh_of(std::size_t vertices, std::vector<std::array<int, 3>> facets) {
  geom::Table<VertexId, Vec3> positions;
  for (std::size_t i = 0; i < vertices; ++i) positions.push_back(Vec3(double(i), double(i * i), 0));
  geom::Table<FacetId, TriMesh::Facet> table;
  for (const auto& f : facets) table.push_back({VertexId(f[0]), VertexId(f[1]), VertexId(f[2])});
  return TriMesh(std::move(positions), std::move(table));
}

std::vector<int> defects_of(const TriMesh& mesh) {
  std::vector<int> result;
  for (const Defect& d : find_defects(mesh)) result.push_back(d.at.value);
  return result;
}

std::vector<int> defects_of(const TriMesh& mesh, const BranchEdges& branches) {
  std::vector<int> result;
  for (const Defect& d : find_defects(mesh, branches)) result.push_back(d.at.value);
  return result;
}

BranchEdges edge(int a, int b, std::size_t facets) {
  return {{geom::mesh_edge(VertexId(a), VertexId(b)), facets}};
}

}  // namespace

TEST_CASE("defects: defects are vertices without triangles, with two fans, with branching links") {
  CHECK(defects_of(mesh_of(3, {{0, 1, 2}})).empty());
  CHECK(defects_of(mesh_of(4, {{0, 1, 2}})) == std::vector<int>{3});
  CHECK(defects_of(mesh_of(5, {{0, 1, 2}, {0, 3, 4}})) == std::vector<int>{0});
  const TriMesh three_at_an_edge = mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  CHECK(defects_of(three_at_an_edge) == std::vector<int>{0, 1});
  CHECK(find_defects(three_at_an_edge)[0].towards == SiteId(1));
  CHECK(defects_of(mesh_of(3, {{0, 1, 2}, {0, 2, 1}})).size() == 3);  // two-sided triangle
  CHECK(defects_of(mesh_of(4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})).empty());
}

TEST_CASE("defects: none where as many triangles meet at an edge as are to be there") {
  const TriMesh three = mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  CHECK(defects_of(three, edge(0, 1, 3)).empty());
  CHECK(defects_of(three, edge(0, 1, 4)) == std::vector<int>{0, 1});
  CHECK(defects_of(three, edge(0, 2, 3)) == std::vector<int>{0, 1, 2});  // there is one
  const TriMesh twice = mesh_of(4, {{0, 1, 2}, {1, 0, 2}, {0, 1, 3}});   // one of three is there again
  CHECK(defects_of(twice, edge(0, 1, 3)) == std::vector<int>{0, 1, 2});
  const TriMesh with_a_fan = mesh_of(7, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 5, 6}});
  CHECK(defects_of(with_a_fan, edge(0, 1, 3)) == std::vector<int>{0});
}

TEST_CASE("defects: edges that branch are those along curves of more than two facets") {
  const TriMesh mesh = fixtures::book(3);
  const Features features = find_features(mesh);
  const FeatureSamples samples = sample_features(mesh, features, {}, Sizing::uniform(0.2), {300, 1});
  const BranchEdges branches = branch_edges(samples);
  CHECK(branches.size() == 5);  // those of the spine, not those of the border
  for (const auto& [ends, facets] : branches) {
    CHECK(facets == 3);
    for (const VertexId v : {ends.first, ends.second}) {
      const Vec3& x = samples.samples[v.index()].position;
      CHECK(Vec3(x.x(), x.y(), 0).norm() < 1e-12);
    }
  }
}

TEST_CASE("defects: a surface that branches has a remesh that branches there, and nothing to mend") {
  for (const int pages : {3, 4, 7}) {
    CAPTURE(pages);
    RemeshOptions options = default_options(500, SizingKind::uniform);
    options.optimize.max_iterations = 20;
    const RemeshResult result = remesh(fixtures::book(pages), options);
    CHECK(result.mesh.num_vertices() == 500);
    CHECK(result.type.ok());
    CHECK(result.brought == 0);
    CHECK(result.broken_feature_edges == 0);
    CHECK(result.measures.theta_min > 25);
    const geom::Topology found = geom::topology(result.mesh);
    CHECK(found.components == 1);
    CHECK(found.euler == 1);
    std::size_t on_spine = 0;
    for (const SurfaceSample& x : result.samples)
      on_spine += Vec3(x.position.x(), x.position.y(), 0).norm() < 1e-12;
    CHECK(found.nonmanifold_edges + 1 == on_spine);
    // On whatever facet of the spine a sample lies, all pages have its triangles.
    std::map<geom::MeshEdge, int> triangles;
    for (const TriMesh::Facet& f : result.mesh.facets())
      for (std::size_t e = 0; e < 3; ++e) ++triangles[geom::mesh_edge(f[e], f[(e + 1) % 3])];
    for (const auto& [ends, count] : triangles) CHECK((count <= 2 || count == pages));
  }
}
