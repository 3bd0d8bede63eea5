#include "fpo/features/features.h"

#include <cmath>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::VertexId;

namespace {

using Edge = std::pair<VertexId, VertexId>;

Edge edge(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Edges of all curves, each as often as it occurs.
std::map<Edge, int> edges_of(const Features& features) {
  std::map<Edge, int> edges;
  for (const FeatureCurve& curve : features.curves) {
    CHECK(curve.facets.size() == curve.vertices.size() - (curve.loop ? 0 : 1));
    for (std::size_t i = 0; i < curve.facets.size(); ++i)
      ++edges[edge(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()])];
  }
  return edges;
}

/// Edges with another number of facets than two, or with normals more than `angle` degrees apart.
std::set<Edge> sharp_edges(const TriMesh& mesh, double angle) {
  std::map<Edge, std::vector<geom::FacetId>> facets;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const TriMesh::Facet& f = mesh.facet(geom::FacetId(t));
      facets[edge(f[i], f[(i + 1) % 3])].emplace_back(t);
    }
  std::set<Edge> sharp;
  for (const auto& [e, at] : facets) {
    const bool fold = at.size() == 2 && mesh.normal(at[0]).normalized().dot(mesh.normal(at[1]).normalized()) <
                                            std::cos(angle * std::acos(-1.0) / 180);
    if (at.size() != 2 || fold) sharp.insert(e);
  }
  return sharp;
}

}  // namespace

TEST_CASE("features: curves hold each sharp edge once, facets are at their edges, ends are corners") {
  for (const char* name : {"cube", "l-block", "frame", "cylinder", "cone", "joint", "square", "tube"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name, 8);
    const Features features = find_features(mesh, {.crease_angle = 50, .weak_crease_angle = 50});
    const std::map<Edge, int> edges = edges_of(features);
    const std::set<Edge> sharp = sharp_edges(mesh, 50);
    CHECK(edges.size() == sharp.size());
    for (const auto& [e, count] : edges) CHECK((count == 1 && sharp.contains(e)));
    const std::set<VertexId> corners(features.corners.begin(), features.corners.end());
    for (const FeatureCurve& curve : features.curves) {
      if (!curve.loop)
        CHECK((corners.contains(curve.vertices.front()) && corners.contains(curve.vertices.back())));
      for (std::size_t i = 1; i + 1 < curve.vertices.size(); ++i) CHECK(!corners.contains(curve.vertices[i]));
      for (std::size_t i = 0; i < curve.facets.size(); ++i)
        for (const VertexId v : {curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()]}) {
          const TriMesh::Facet& f = mesh.facet(curve.facets[i]);
          CHECK(std::ranges::find(f, v) != f.end());
        }
    }
  }
}

TEST_CASE("features: the corners and curves that shapes have, however fine the mesh") {
  struct Expected {
    const char* name;
    std::size_t corners, curves;
  };
  for (const Expected& shape : {Expected{"cube", 8, 12},
                                {"l-block", 12, 18},
                                {"frame", 16, 24},
                                {"cylinder", 0, 2},
                                {"square", 4, 4},
                                {"triangle", 3, 3},
                                {"tube", 0, 2},
                                {"moebius", 0, 1},
                                {"torus", 0, 0}})
    for (const int size : {24, 48}) {
      CAPTURE(shape.name);
      CAPTURE(size);
      const Features features = find_features(geom::tilted(geom::make_shape(shape.name, size)));
      CHECK(features.corners.size() == shape.corners);
      CHECK(features.curves.size() == shape.curves);
    }
}

TEST_CASE("features: a jagged border has corners at a fine scale, none at a coarse one") {
  geom::Table<VertexId, geom::Vec3> vertices{geom::Vec3(0, 0, 0)};
  geom::Table<geom::FacetId, TriMesh::Facet> facets;
  const int k = 40;
  for (int i = 0; i < k; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / k, r = i % 2 ? 1 : 1.15;
    vertices.push_back(geom::Vec3(r * std::cos(angle), r * std::sin(angle), 0));
    facets.push_back({VertexId(0), VertexId(1 + i), VertexId(1 + (i + 1) % k)});
  }
  const TriMesh star(vertices, facets);
  CHECK(find_features(star).corners.size() == k);
  CHECK(find_features(star, {.turn_scale = 0.5}).corners.empty());
}

TEST_CASE("features: creases that fade out are no features by default options of the tool") {
  const TriMesh cube = fixtures::box(geom::Vec3(1, 1, 1), 4);
  CHECK(find_features(cube, automatic_features()).curves.size() == 12);
  // A square with a fold along its middle that gets flat.
  constexpr int k = 16;
  TriMesh flat = fixtures::tilted_square(k);
  auto vertices = flat.vertices();
  const geom::Vec3 up = flat.normal(geom::FacetId(0)).normalized();
  for (int i = 0; i <= k; ++i)
    for (int j = 0; j <= k; ++j) {
      const double left = std::max(0.6 - double(i) / k, 0.0), aside = std::abs(double(j) / k - 0.5);
      vertices[VertexId(i * (k + 1) + j)] -= 2.5 * left * left * aside * up;
    }
  const TriMesh tent(vertices, flat.facets());
  const auto creases = [&](const FeatureOptions& options) {
    return std::ranges::count(find_features(tent, options).curves, 2u, &FeatureCurve::sheets);
  };
  CHECK(creases({.crease_angle = 20, .weak_crease_angle = 20}) > 0);
  CHECK(creases(automatic_features()) == 0);
}
