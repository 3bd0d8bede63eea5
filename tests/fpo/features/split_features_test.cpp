#include "fpo/features/split_features.h"

#include <algorithm>
#include <set>
#include <utility>

#include "doctest.h"
#include "fpo/features/feature_choice.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/book.h"

using namespace fpo;
using geom::TriMesh;
using geom::VertexId;

namespace {

SplitSurface split(const TriMesh& mesh, double most) {
  return split_long_edges(mesh, Sizing::uniform(most * mesh.diagonal()), 1, {});
}

std::set<std::pair<VertexId, VertexId>> edges_of(const Features& features) {
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t i = 0; i < curve.facets.size(); ++i)
      edges.insert(std::minmax(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()]));
  return edges;
}

bool has_edge(const TriMesh::Facet& facet, VertexId a, VertexId b) {
  return std::ranges::find(facet, a) != facet.end() && std::ranges::find(facet, b) != facet.end();
}

void check_curve(const TriMesh& mesh, const FeatureCurve& was, const SplitSurface& split,
                 const FeatureCurve& is) {
  CHECK(is.loop == was.loop);
  CHECK(is.sheets == was.sheets);
  REQUIRE(is.vertices.size() == is.facets.size() + (is.loop ? 0 : 1));
  CHECK(is.vertices.front() == was.vertices.front());
  if (!is.loop) CHECK(is.vertices.back() == was.vertices.back());
  CHECK(length_of(split.mesh, is) == doctest::Approx(length_of(mesh, was)).epsilon(1e-12));
  for (std::size_t i = 0; i < is.facets.size(); ++i)
    CHECK(
        has_edge(split.mesh.facet(is.facets[i]), is.vertices[i], is.vertices[(i + 1) % is.vertices.size()]));
}

}  // namespace

TEST_CASE("split features: the curves of the surface, edge by edge, as they are found on the split one") {
  std::vector<TriMesh> surfaces{fixtures::block(10, 4, 0.3), fixtures::book(4)};
  for (const char* name : {"hole-plate", "joint", "square", "moebius", "wave-disk", "cylinder"})
    surfaces.push_back(geom::make_shape(name));
  for (const TriMesh& mesh : surfaces)
    for (const double most : {1.0, 0.05, 0.01}) {
      const Features was = find_features(mesh);
      REQUIRE(!was.curves.empty());
      const SplitSurface finer = split(mesh, most);
      const Features is = split_features(was, mesh, finer);
      CHECK(is.corners == was.corners);
      REQUIRE(is.curves.size() == was.curves.size());
      for (std::size_t c = 0; c < is.curves.size(); ++c)
        check_curve(mesh, was.curves[c], finer, is.curves[c]);
      CHECK(edges_of(is) == edges_of(find_features(finer.mesh)));
    }
}

TEST_CASE("split features: curves that were led to another end, and others that are not kept") {
  const TriMesh mesh = geom::make_shape("gear");
  const double spacing = hexagonal_spacing(mesh.area(), 300);
  const FeatureChoice choice = choose_features(mesh, automatic_features(),
                                               {.num_samples = 300, .spacing = spacing, .strong_only = true});
  REQUIRE(choice.collapsed > 0);
  const SplitSurface finer = split(mesh, 0.01);
  REQUIRE(finer.mesh.num_facets() > mesh.num_facets());
  const Features is = split_features(choice.features, mesh, finer);
  REQUIRE(is.curves.size() == choice.features.curves.size());
  CHECK(edges_of(is).size() < edges_of(find_features(finer.mesh)).size());
  for (std::size_t c = 0; c < is.curves.size(); ++c)
    check_curve(mesh, choice.features.curves[c], finer, is.curves[c]);
}
