// Remeshes that are brought from one surface to another.

#include "fpo/remesh/stand_in_remesh.h"

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/barycentric.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

namespace {

using geom::TriMesh;
using geom::Vec3;

fpo::RemeshOptions options_for(std::size_t n) {
  fpo::RemeshOptions options = fpo::default_options(n, fpo::SizingKind::uniform);
  options.optimize.max_iterations = 5;
  return options;
}

}  // namespace

TEST_CASE("brought to another surface, a remesh has its samples there, its type, and measures of its own") {
  const TriMesh sphere = geom::make_shape("sphere", 8);
  const TriMesh egg = geom::mapped(sphere, [](const Vec3& p) { return Vec3(p.x(), p.y(), 1.5 * p.z()); });
  const fpo::RemeshOptions options = options_for(100);
  fpo::RemeshResult result = fpo::remesh(sphere, options);
  const std::vector<Vec3> weights = fpo::barycentric_coordinates(sphere, result.samples);
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    fpo::SurfaceSample& x = result.samples[i];
    x.position = Vec3(0, 0, 0);
    for (int k = 0; k < 3; ++k) x.position += weights[i][k] * egg.corner(x.facet, k);
  }
  const double before = result.measures.mean_edge;
  const fpo::RemeshResult there = fpo::with_mesh_on(egg, std::move(result), options);
  for (std::size_t i = 0; i < there.samples.size(); ++i)
    CHECK(there.mesh.vertices()[geom::VertexId(i)] == there.samples[i].position);
  const geom::Topology t = geom::topology(there.mesh);
  CHECK(t.manifold());
  CHECK(t.euler == 2);
  const fpo::FinalMeasures again =
      fpo::final_measures(there.mesh, there.wanted, 0, fpo::AngleOptions(options.angles));
  CHECK(there.measures.theta_min == again.theta_min);
  CHECK(there.measures.mean_edge == again.mean_edge);
  CHECK(there.measures.mean_edge > 1.05 * before);
}
