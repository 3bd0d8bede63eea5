#include "fpo/surface/split_facets.h"

#include <cmath>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/mesh_parts.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

TEST_CASE("split facets: short edges, the same surface, samples in parts of their facets") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    for (const bool adaptive : {false, true}) {
      VertexField lengths;
      for (const Vec3& p : mesh.vertices())
        lengths.push_back(mesh.diagonal() * (0.02 + 0.02 * (p - mesh.box().min()).norm() / mesh.diagonal()));
      const Sizing sizing = adaptive ? Sizing(mesh, lengths) : Sizing::uniform(0.03 * mesh.diagonal());
      const std::vector<SurfaceSample> before = random_samples(mesh, sizing, 100, 3);
      std::vector<SurfaceSample> samples = before;
      const SplitSurface split = split_long_edges(mesh, sizing, 2, samples);
      const Sizing there = adaptive ? Sizing(split.mesh, split.h) : sizing;
      CHECK_FALSE(has_long_edges(split.mesh, there, 2));
      CHECK(split.h.empty() == !adaptive);
      CHECK(split.mesh.area() == doctest::Approx(mesh.area()));
      const geom::Topology was = geom::topology(mesh), is = geom::topology(split.mesh);
      CHECK(is.euler == was.euler);
      CHECK(is.boundary_loops == was.boundary_loops);
      CHECK(is.misoriented_edges == was.misoriented_edges);
      std::vector<double> areas(mesh.num_facets(), 0);
      for (FacetId t(0); t.index() < split.mesh.num_facets(); t = FacetId(t.value + 1)) {
        const FacetId parent = split.parents[t];
        areas[parent.index()] += split.mesh.area(t);
        CHECK(split.mesh.normal(t).dot(mesh.normal(parent)) > 0);
      }
      for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
        CHECK(areas[t.index()] == doctest::Approx(mesh.area(t)));
      for (std::size_t i = 0; i < samples.size(); ++i) {
        CHECK(split.parents[samples[i].facet] == before[i].facet);
        const std::array<Vec3, 3> part{split.mesh.corner(samples[i].facet, 0),
                                       split.mesh.corner(samples[i].facet, 1),
                                       split.mesh.corner(samples[i].facet, 2)};
        CHECK(std::sqrt(geom::closest_point(samples[i].position, part).distance2) < 1e-12 * mesh.diagonal());
        CHECK(there.at(samples[i]) == doctest::Approx(sizing.at(before[i])));
      }
    }
  }
}

TEST_CASE("split facets: a needle is not split to the end where that makes more parts than wanted") {
  geom::MeshArrays needle;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1e9, 0, 0), Vec3(0, 1, 0)}) needle.add(p);
  needle.add_triangle(VertexId(0), VertexId(1), VertexId(2));
  const TriMesh mesh = needle.take();
  const Sizing sizing = Sizing::uniform(1);
  const SplitSurface split = split_long_edges(mesh, sizing, 2, {}, 1000);
  CHECK(has_long_edges(split.mesh, sizing, 2));
  CHECK(split.mesh.num_facets() > 1000);
  CHECK(split.mesh.num_facets() <= 4000);  // each halving makes at most four of one
  CHECK(split.mesh.area() == doctest::Approx(mesh.area()));
}
