#include "fpo/remesh/far_part.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

/// By brute force: the vertex farthest from the remesh in wanted lengths.
double farthest_of_all(const TriMesh& surface, const VertexField& wanted, const TriMesh& remesh) {
  const geom::AabbTree tree(remesh);
  double most = 0;
  for (std::size_t v = 0; v < surface.num_vertices(); ++v)
    most = std::max(most,
                    std::sqrt(tree.closest(surface.position(VertexId(v))).distance2) / wanted[VertexId(v)]);
  return most;
}

RemeshResult remesh_of(const TriMesh& surface, std::size_t n) {
  RemeshOptions options;
  options.num_samples = n;
  options.optimize.max_iterations = 5;
  return remesh(surface, options);
}

}  // namespace

TEST_CASE("far part: where a vertex is farther than the length wanted there it is found, by brute force") {
  int told = 0, untold = 0;
  for (const char* name : {"sphere", "horn", "ears", "torus", "two-spheres"})
    for (const std::size_t n : {40u, 100u, 400u}) {
      CAPTURE(std::string(name));
      CAPTURE(n);
      const TriMesh surface = geom::make_shape(name, 16);
      const RemeshResult result = remesh_of(surface, n);
      if (result.mesh.num_facets() == 0) continue;
      for (const double factor : {1.0, 0.5, 0.25, 0.1}) {  // as if shorter lengths had been wanted
        VertexField wanted = result.sizing;
        for (double& h : wanted) h *= factor;
        const double most = farthest_of_all(surface, wanted, result.mesh);
        const FarPart found = far_part(surface, wanted, result.mesh, result.samples);
        CHECK(found.of_wanted == doctest::Approx(most > 1 ? most : 0));
        if (found.of_wanted > 0) CHECK(found.distance > 0);
        ++(found.of_wanted > 0 ? told : untold);
      }
    }
  CHECK(told > 3);
  CHECK(untold > 3);
}

TEST_CASE("far part: none of a mesh without facets, and parts without samples are no matter") {
  const TriMesh spheres = geom::make_shape("two-spheres", 2);
  const VertexField wanted(spheres.num_vertices(), 0.3);
  CHECK(far_part(spheres, wanted, TriMesh(), {}).of_wanted == 0);
  geom::Table<FacetId, TriMesh::Facet> facets;  // the first sphere alone, of which each vertex is a sample
  for (std::size_t t = 0; t < spheres.num_facets() / 2; ++t) facets.push_back(spheres.facet(FacetId(t)));
  const TriMesh one(spheres.vertices(), facets);
  std::vector<SurfaceSample> samples(spheres.num_vertices());
  for (std::size_t t = 0; t < facets.size(); ++t)
    for (const VertexId v : one.facet(FacetId(t))) samples[v.index()] = {one.position(v), FacetId(t)};
  samples.resize(spheres.num_vertices() / 2);
  CHECK(far_part(spheres, wanted, one, samples).of_wanted == 0);
}
