#include "fpo/surface/surface_cover.h"

#include <cmath>
#include <limits>

#include "../../fixtures/surfaces.h"
#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "geom/sites/site_tree.h"

using fpo::CoverPoint;
using fpo::surface_cover;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

namespace {

std::vector<fixtures::NamedSurface> covered_surfaces() {
  std::vector<fixtures::NamedSurface> list = fixtures::surfaces();
  list.push_back({"joint", geom::make_shape("joint")});
  list.push_back({"cylinder", geom::make_shape("cylinder")});
  list.push_back({"moebius", geom::make_shape("moebius")});
  return list;
}

double edge_length(const TriMesh& mesh) {
  double sum = 0;
  for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) sum += (mesh.corner(t, (e + 1) % 3) - mesh.corner(t, e)).norm();
  return sum;
}

}  // namespace

TEST_CASE("surface cover: a point within the spacing of every location, all on the surface, not too many") {
  for (const auto& named : covered_surfaces()) {
    CAPTURE(named.name);
    const TriMesh& mesh = named.mesh;
    const geom::AabbTree surface(mesh);
    for (const double share : {0.3, 0.1, 0.02}) {
      const double spacing = share * std::sqrt(mesh.area());
      const std::vector<CoverPoint> points = surface_cover(mesh, spacing, 1);
      geom::SiteTree tree;
      double off = 0, bad_normals = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        tree.insert(SiteId(i), {points[i].position, 0.0});
        off = std::max(off, std::sqrt(surface.closest(points[i].position).distance2));
        bad_normals += std::abs(points[i].normal.norm() - 1) > 1e-12;
      }
      CHECK(off < 1e-12 * mesh.diagonal());
      CHECK(bad_normals == 0);
      double farthest = 0;
      for (const fpo::SurfaceSample& x : fpo::random_samples(mesh, 3000, 5))
        farthest = std::max(farthest, std::sqrt(tree.nearest(x.position, SiteId()).radius2));
      CHECK(farthest <= spacing);
      const double most = mesh.area() / (std::sqrt(0.75) * spacing * spacing) + edge_length(mesh) / spacing;
      CHECK(static_cast<double>(points.size()) <= static_cast<double>(mesh.num_vertices()) + 1.1 * most);
      CHECK(static_cast<double>(points.size()) <= 1.1 * fpo::cover_size(mesh, spacing));
    }
  }
}

TEST_CASE("surface cover: the vertices alone if the spacing is 0, but those that no facet names") {
  const TriMesh mesh({Vec3(0, 0, 0), Vec3(9, 9, 9), Vec3(1, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 1)},
                     {{geom::VertexId(0), geom::VertexId(2), geom::VertexId(3)},
                      {geom::VertexId(0), geom::VertexId(4), geom::VertexId(2)}});
  const std::vector<CoverPoint> points = surface_cover(mesh, 0, 1);
  REQUIRE(points.size() == 4);
  CHECK(points[0].normal.isApprox(Vec3(0, 1, 3).normalized()));
  CHECK(points[2].position == Vec3(0, 3, 0));
  CHECK(points[2].normal.isApprox(Vec3(0, 0, 1)));
  CHECK(points[2].facet_edge == doctest::Approx(std::sqrt(10)));
  CHECK(points[3].facet_edge == doctest::Approx(std::sqrt(2)));
}

TEST_CASE("surface cover: scales exactly with powers of two, and every seed has its own points") {
  const TriMesh mesh = fixtures::three_components();
  geom::Table<geom::VertexId, Vec3> vertices = mesh.vertices();
  for (Vec3& v : vertices) v *= 0x1p12;
  const TriMesh larger(std::move(vertices), mesh.facets());
  const auto points = surface_cover(mesh, 0.07, 4), scaled = surface_cover(larger, 0.07 * 0x1p12, 4);
  REQUIRE(points.size() == scaled.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    different += points[i].position * 0x1p12 != scaled[i].position;
  CHECK(different == 0);
  CHECK(surface_cover(mesh, 0.07, 5).back().position != points.back().position);
}

TEST_CASE("surface cover: impossible spacings are refused") {
  const TriMesh mesh = fixtures::blob(3);
  for (const double spacing : {-1.0, 1e-9, std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_THROWS_AS(surface_cover(mesh, spacing, 1), geom::InputError);
}
