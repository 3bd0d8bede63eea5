// Coarser surfaces in the place of needles.

#include "fpo/remesh/stand_in.h"

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/needles.h"
#include "tests/io/sample_meshes.h"

namespace {

using geom::TriMesh;

double spacing_of(const TriMesh& mesh, std::size_t n) { return fpo::hexagonal_spacing(mesh.area(), n); }

/// Of the vertices and middles of one mesh from another.
double farthest(const TriMesh& from, const TriMesh& to) {
  const geom::AabbTree tree(to);
  double most = 0;
  for (std::size_t t = 0; t < from.num_facets(); ++t) {
    const geom::FacetId f(t);
    const geom::Vec3 middle = (from.corner(f, 0) + from.corner(f, 1) + from.corner(f, 2)) / 3;
    for (const geom::Vec3& x : {from.corner(f, 0), middle}) most = std::max(most, tree.closest(x).distance2);
  }
  return std::sqrt(most);
}

std::vector<TriMesh> needles() {
  return {fixtures::fan(6000), fixtures::fan(2000, 30), fixtures::cylinder_of_needles(2000),
          fixtures::stretched_sphere(100, 50, 1000)};
}

}  // namespace

TEST_CASE("stand-in: near the surface, of its type, and without needles") {
  constexpr std::size_t n = 300;
  for (const TriMesh& mesh : needles()) {
    CAPTURE(mesh.num_facets());
    const double h = spacing_of(mesh, n);
    REQUIRE(fpo::has_needles(mesh, n, h));
    const TriMesh coarse = fpo::stand_in(mesh, h);
    CHECK(!fpo::has_needles(coarse, n, h));
    CHECK(coarse.num_facets() < mesh.num_facets() / 3);
    const geom::Topology before = geom::topology(mesh), after = geom::topology(coarse);
    CHECK(after.manifold());
    CHECK(after.euler == before.euler);
    CHECK(after.components == before.components);
    CHECK(after.boundary_loops == before.boundary_loops);
    CHECK(after.misoriented_edges == 0);
    CHECK(farthest(mesh, coarse) < h / 6);
    CHECK(farthest(coarse, mesh) < h / 6);
    CHECK(fixtures::identical(fpo::stand_in(mesh, h), coarse));
  }
}

TEST_CASE("stand-in: ordinary surfaces have no needles, however many samples there are") {
  for (const char* name : {"sphere", "torus", "joint", "cube", "thin-plate", "cone", "cylinder", "wave-disk"})
    for (const std::size_t n : {20, 500, 20'000, 1'000'000}) {
      CAPTURE(name);
      CAPTURE(n);
      const TriMesh mesh = geom::make_shape(name);
      CHECK(!fpo::has_needles(mesh, n, spacing_of(mesh, n)));
    }
}

TEST_CASE("stand-in: samples are brought to the surface") {
  const TriMesh mesh = fixtures::fan(500, 2);
  std::vector<fpo::SurfaceSample> samples;
  for (int i = 0; i < 20; ++i) samples.push_back({fixtures::on_circle(i, 20, 0.1 * i), geom::FacetId(0)});
  const geom::AabbTree tree(mesh);
  const std::vector<fpo::SurfaceSample> brought = fpo::brought_to(mesh, samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK((brought[i].position - tree.closest(samples[i].position).point).norm() < 1e-12);
    CHECK(geom::closest_point(brought[i].position, tree.triangle(brought[i].facet)).distance2 < 1e-24);
  }
}

TEST_CASE("stand-in: samples are brought to their own sheet, were the other one nearer") {
  const TriMesh fine = geom::make_shape("sphere", 40);
  const auto turned = [](const TriMesh& mesh, double scale) {
    geom::Table<geom::FacetId, TriMesh::Facet> facets = mesh.facets();
    for (TriMesh::Facet& f : facets) std::swap(f[1], f[2]);
    geom::Table<geom::VertexId, geom::Vec3> positions = mesh.vertices();
    for (geom::Vec3& x : positions) x *= scale;
    return TriMesh(std::move(positions), std::move(facets));
  };
  const TriMesh shell = geom::joined(fine, turned(fine, 0.9995));
  const TriMesh coarse = geom::make_shape("sphere", 6);  // its middles are inside both
  std::vector<fpo::SurfaceSample> outside, inside;
  for (std::size_t t = 0; t < coarse.num_facets(); ++t) {
    const geom::FacetId f(t);
    outside.push_back({(coarse.corner(f, 0) + coarse.corner(f, 1) + coarse.corner(f, 2)) / 3, f});
  }
  inside = outside;
  for (const auto& x : fpo::brought_to(shell, outside, coarse)) CHECK(x.facet.index() < fine.num_facets());
  for (const auto& x : fpo::brought_to(shell, inside, turned(coarse, 1)))
    CHECK(x.facet.index() >= fine.num_facets());
  std::size_t elsewhere = 0;
  for (const auto& x : fpo::brought_to(shell, outside)) elsewhere += x.facet.index() >= fine.num_facets();
  CHECK(elsewhere > 0);
}

TEST_CASE("remesh: needles give a good surface of their type") {
  for (const TriMesh& mesh : {fixtures::fan(3000), fixtures::fan(3000, 2)}) {
    fpo::RemeshOptions options;
    options.num_samples = 150;
    options.features = fpo::FeatureOptions{};
    options.optimize.max_iterations = 20;
    const fpo::RemeshResult result = fpo::remesh(mesh, options);
    CHECK(result.stood_in);
    CHECK(!result.made_coarser);
    const geom::Topology t = geom::topology(result.mesh);
    CHECK(t.vertices == 150);
    CHECK(t.manifold());
    CHECK(t.euler == 1);
    CHECK(fpo::quality(result.mesh, mesh.area()).theta_min > 25);
    for (const fpo::SurfaceSample& x : result.samples)
      CHECK(geom::closest_point(x.position,
                                {mesh.corner(x.facet, 0), mesh.corner(x.facet, 1), mesh.corner(x.facet, 2)})
                .distance2 < 1e-24);
  }
}
