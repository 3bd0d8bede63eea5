// Clustering against its definition.

#include "geom/mesh/vertex_clusters.h"

#include <cmath>
#include <set>

#include "doctest.h"
#include "geom/shapes/shapes.h"

using geom::FacetId;
using geom::TriMesh;

TEST_CASE("vertex clusters: few facets, near the surface, of about its area") {
  const TriMesh mesh = geom::make_shape("torus");
  for (const std::size_t most : {mesh.num_facets() - 1, mesh.num_facets() / 2, mesh.num_facets() / 5}) {
    CAPTURE(most);
    double width = 0;
    const TriMesh coarse = geom::with_fewer_facets(mesh, most, &width);
    CHECK(width > 0);
    CHECK(coarse.num_facets() <= most);
    CHECK(coarse.num_facets() > most / 8);
    std::set<TriMesh::Facet> facets(coarse.facets().begin(), coarse.facets().end());
    CHECK(facets.size() == coarse.num_facets());
    CHECK(coarse.area() < 1.2 * mesh.area());
    CHECK(coarse.area() > 0.7 * mesh.area());
    for (const geom::Vec3& p : coarse.vertices()) {
      double nearest = INFINITY;
      for (const geom::Vec3& q : mesh.vertices()) nearest = std::min(nearest, (p - q).norm());
      CHECK(nearest <= std::sqrt(3.0) * width);
    }
  }
}

TEST_CASE("vertex clusters: small meshes stay, a wide cell swallows everything") {
  const TriMesh mesh = geom::make_shape("cube");
  double width = 1;
  CHECK(geom::with_fewer_facets(mesh, mesh.num_facets(), &width).num_facets() == mesh.num_facets());
  CHECK(width == 0);
  CHECK(geom::clustered(mesh, 1e-3 * mesh.diagonal()).num_facets() == mesh.num_facets());
  CHECK(geom::clustered(mesh, 2 * mesh.diagonal()).num_facets() == 0);
}
