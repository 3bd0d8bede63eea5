#include "geom/shapes/shapes.h"

#include <cmath>
#include <numbers>
#include <string>

#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/polygonise.h"
#include "tests/fixtures/volume.h"

using fixtures::volume;
using geom::TriMesh;
using geom::Vec3;

namespace {

bool equal(const TriMesh& a, const TriMesh& b) {
  return a.vertices() == b.vertices() && a.facets() == b.facets();
}

double smallest_angle(const TriMesh& mesh) {
  double smallest = 180;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.corner(geom::FacetId(t), (i + 1) % 3) - mesh.corner(geom::FacetId(t), i);
      const Vec3 b = mesh.corner(geom::FacetId(t), (i + 2) % 3) - mesh.corner(geom::FacetId(t), i);
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
  }
  return smallest;
}

void check_topology(const geom::ShapeInfo& info, int size) {
  CAPTURE(std::string(info.name));
  CAPTURE(size);
  const TriMesh mesh = geom::make_shape(info.name, size);
  const geom::Topology t = geom::topology(mesh);
  CHECK(t.manifold());
  CHECK(t.euler == info.euler);
  CHECK(t.components == info.components);
  CHECK(t.boundary_loops == info.boundary_loops);
  CHECK((t.misoriented_edges == 0) == info.orientable);
  CHECK(t.unreferenced_vertices == 0);
  for (std::size_t f = 0; f < mesh.num_facets(); ++f) REQUIRE(mesh.area(geom::FacetId(f)) > 0);
  if (info.boundary_loops == 0) CHECK(volume(mesh) > 0);
}

}  // namespace

TEST_CASE("shapes: each has the topology of its row, at several sizes") {
  for (const geom::ShapeInfo& info : geom::shape_table()) {
    const bool on_lattice = info.name == "double-torus";
    for (const int size : {0, on_lattice ? 31 : 3, on_lattice ? 47 : 10}) check_topology(info, size);
    CHECK(equal(geom::make_shape(info.name), geom::make_shape(info.name, info.size)));
  }
}

TEST_CASE("shapes: areas and volumes approach those of the bodies") {
  const double pi = std::numbers::pi;
  CHECK(geom::make_shape("cube", 3).area() == doctest::Approx(6));
  CHECK(volume(geom::make_shape("cube", 3)) == doctest::Approx(1));
  CHECK(volume(geom::make_shape("l-block")) == doctest::Approx(0.375));
  CHECK(volume(geom::make_shape("frame", 2)) == doctest::Approx(8));
  CHECK(volume(geom::make_shape("thin-plate")) == doctest::Approx(1.0 / 500));
  CHECK(geom::make_shape("square", 4).area() == doctest::Approx(1));
  CHECK(geom::make_shape("triangle", 4).area() == doctest::Approx(std::sqrt(3) / 4));
  CHECK(volume(geom::make_shape("sphere", 40)) == doctest::Approx(4 * pi / 3).epsilon(0.002));
  CHECK(volume(geom::make_shape("torus", 200)) == doctest::Approx(2 * pi * pi * 0.16).epsilon(0.005));
  CHECK(volume(geom::make_shape("cylinder", 200)) == doctest::Approx(2 * pi).epsilon(0.001));
  CHECK(volume(geom::make_shape("cone", 200)) == doctest::Approx(pi / 6).epsilon(0.001));
  CHECK(geom::make_shape("tube", 200).area() == doctest::Approx(4 * pi).epsilon(0.001));
}

TEST_CASE("shapes: the simplest ones have the fewest facets") {
  CHECK(geom::make_shape("cube").num_facets() == 12);
  CHECK(geom::make_shape("square").num_facets() == 2);
  CHECK(geom::make_shape("triangle").num_facets() == 1);
  CHECK(geom::make_shape("sphere", 1).num_facets() == 20);
}

TEST_CASE("shapes: the two spheres come close but do not touch") {
  const TriMesh mesh = geom::make_shape("two-spheres");
  double left = -10, right = 10;
  for (const Vec3& p : mesh.vertices()) {
    CHECK(std::abs(p.x()) >= 0.0005 - 1e-12);
    if (p.x() < 0) left = std::max(left, p.x());
    if (p.x() > 0) right = std::min(right, p.x());
  }
  CHECK(right - left < 0.02);
}

TEST_CASE("shapes: only the blob depends on the seed") {
  for (const geom::ShapeInfo& info : geom::shape_table()) {
    CAPTURE(std::string(info.name));
    CHECK(equal(geom::make_shape(info.name, 0, 1), geom::make_shape(info.name, 0, 1)));
    CHECK(equal(geom::make_shape(info.name, 0, 1), geom::make_shape(info.name, 0, 2)) ==
          (info.name != "blob"));
  }
}

TEST_CASE("shapes: bad names and sizes are refused") {
  CHECK_THROWS_AS(geom::make_shape("klein-bottle"), geom::InputError);
  CHECK_THROWS_AS(geom::make_shape("torus", 2), geom::InputError);
  CHECK_THROWS_AS(geom::make_shape("cube", -1), geom::InputError);
  CHECK_THROWS_AS(geom::make_shape("cube", 1'000'000), geom::InputError);
  CHECK_THROWS_AS(geom::make_shape("double-torus", 4), geom::InputError);
}

TEST_CASE("shapes: a tilt keeps area and topology and leaves no facet parallel to a coordinate plane") {
  const TriMesh cube = geom::make_shape("cube", 4), turned = geom::tilted(cube);
  CHECK(turned.area() == doctest::Approx(cube.area()));
  CHECK(turned.facets() == cube.facets());
  for (std::size_t f = 0; f < turned.num_facets(); ++f) {
    CHECK(turned.normal(geom::FacetId(f)).normalized().cwiseAbs().minCoeff() > 0.01);
  }
}

TEST_CASE("polygonised: vertices lie on the surface, triangles are decent") {
  const geom::ImplicitSurface sphere = {[](const Vec3& p) {
                                          return geom::ImplicitSurface::Sample{p.squaredNorm() - 1, 2 * p};
                                        },
                                        geom::Box3(Vec3::Constant(-1.2), Vec3::Constant(1.2))};
  for (const int cells : {7, 20, 33}) {
    const TriMesh mesh = geom::polygonised(sphere, cells);
    CHECK(geom::topology(mesh).euler == 2);
    CHECK(geom::topology(mesh).manifold());
    for (const Vec3& p : mesh.vertices()) CHECK(p.norm() == doctest::Approx(1).epsilon(1e-12));
    CHECK(smallest_angle(mesh) > 15);
    CHECK(volume(mesh) > 0);
  }
  CHECK(smallest_angle(geom::make_shape("double-torus")) > 15);
}

TEST_CASE("polygonised: saddles at every inclination to the lattice stay manifold") {
  const double k = 5, depth = 0.6;
  const geom::ImplicitSurface sponge = {
      [&](const Vec3& p) {
        const Vec3 s = (k * p).array().sin(), c = (k * p).array().cos();
        const double waves = s.x() * c.y() + s.y() * c.z() + s.z() * c.x();
        const Vec3 slope(c.x() * c.y() - s.z() * s.x(), c.y() * c.z() - s.x() * s.y(),
                         c.z() * c.x() - s.y() * s.z());
        return geom::ImplicitSurface::Sample{p.squaredNorm() - 1 + depth * waves, 2 * p + depth * k * slope};
      },
      geom::Box3(Vec3::Constant(-2), Vec3::Constant(2))};
  const long euler = geom::topology(geom::polygonised(sponge, 60)).euler;
  for (int cells = 40; cells < 52; ++cells) {
    const TriMesh mesh = geom::polygonised(sponge, cells);
    CHECK(geom::topology(mesh).manifold());
    CHECK(geom::topology(mesh).boundary_edges == 0);
    CHECK(geom::topology(mesh).misoriented_edges == 0);
    CHECK(geom::topology(mesh).euler == euler);
  }
}

TEST_CASE("polygonised: refuses a surface that reaches its box") {
  const geom::ImplicitSurface plane = {[](const Vec3& p) {
                                         return geom::ImplicitSurface::Sample{p.z() - 0.1, Vec3(0, 0, 1)};
                                       },
                                       geom::Box3(Vec3::Constant(-1), Vec3::Constant(1))};
  CHECK_THROWS_AS(geom::polygonised(plane, 8), geom::InputError);
}

TEST_CASE("subdivided: k^2 facets for one, the same Euler number and area") {
  for (const char* name : {"cube", "triangle", "frame", "moebius"}) {
    const TriMesh coarse = geom::make_shape(name);
    for (const int k : {1, 2, 5}) {
      const TriMesh fine = geom::subdivided(coarse, k);
      CHECK(fine.num_facets() == coarse.num_facets() * static_cast<std::size_t>(k) * k);
      CHECK(fine.area() == doctest::Approx(coarse.area()));
      CHECK(geom::topology(fine).euler == geom::topology(coarse).euler);
      CHECK(geom::topology(fine).manifold());
    }
  }
}
