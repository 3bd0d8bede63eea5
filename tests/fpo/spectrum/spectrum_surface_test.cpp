#include "fpo/spectrum/spectrum_surface.h"

#include <cmath>

#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sample_sets.h"
#include "tests/fixtures/surfaces.h"

using fpo::SpectrumPoint;
using fpo::SpectrumSurface;
using fpo::SurfacePiece;
using geom::Vec3;

namespace {

double total_area(const std::vector<SurfacePiece>& pieces) {
  double sum = 0;
  for (const SurfacePiece& p : pieces) sum += p.area;
  return sum;
}

/// How far the pieces' center of gravity is from the mesh's.
double center_error(const std::vector<SurfacePiece>& pieces, const geom::TriMesh& mesh) {
  Vec3 error(0, 0, 0);
  for (const SurfacePiece& p : pieces) error += p.area * p.at.position;
  for (std::size_t f = 0; f < mesh.num_facets(); ++f) {
    const geom::FacetId t(f);
    error -= mesh.area(t) * (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
  }
  return error.norm() / mesh.area();
}

}  // namespace

TEST_CASE("SpectrumSurface: a sphere's normals are smooth, a box keeps its sides") {
  const geom::TriMesh sphere = geom::make_shape("sphere", 12);
  const SpectrumSurface smooth(sphere);
  for (const auto& p : fixtures::random_on(sphere, 300, 1))
    CHECK((smooth.place(p.position).normal - p.position.normalized()).norm() < 0.01);
  const geom::TriMesh cube = fixtures::box({1, 1, 1}, 3);
  const SpectrumSurface flat(cube);
  for (const auto& p : fixtures::random_on(cube, 300, 2)) {
    const Vec3 n = flat.place(p.position).normal, outwards = p.position - Vec3(0.5, 0.5, 0.5);
    CHECK(n.cwiseAbs().maxCoeff() == doctest::Approx(1));
    CHECK(n.dot(outwards) == doctest::Approx(0.5));  // of the side that it lies on
  }
}

TEST_CASE("SpectrumSurface: values at vertices are interpolated linearly at the nearest point") {
  const geom::TriMesh mesh = fixtures::blob(5);
  const SpectrumSurface surface(mesh);
  const Vec3 slope(1, -2, 3);
  fpo::VertexField values;
  for (const Vec3& x : mesh.vertices()) values.push_back(7 + slope.dot(x));
  for (const auto& p : fixtures::random_on(mesh, 200, 3))
    CHECK(surface.interpolated(p.position, values) == doctest::Approx(7 + slope.dot(p.position)));
}

TEST_CASE("SpectrumSurface: pieces make up the surface and keep to a limit, constant or not") {
  for (const fixtures::NamedSurface& s : fixtures::surfaces()) {
    CAPTURE(s.name);
    const SpectrumSurface surface(s.mesh);
    CHECK(surface.area() == doctest::Approx(s.mesh.area()));
    const double part = s.mesh.area() / 700;
    const auto even = surface.pieces([&](const SpectrumPoint&) { return part; });
    const Vec3 low = s.mesh.box().min();
    const auto graded = surface.pieces(
        [&](const SpectrumPoint& x) { return part * (0.2 + (x.position - low).norm() / s.mesh.diagonal()); });
    for (const auto* pieces : {&even, &graded}) {
      CHECK(total_area(*pieces) == doctest::Approx(s.mesh.area()));
      CHECK(center_error(*pieces, s.mesh) < 1e-9 * s.mesh.diagonal());
      for (const SurfacePiece& p : *pieces) CHECK(std::abs(p.at.normal.norm() - 1) < 1e-9);
    }
    for (const SurfacePiece& p : even) CHECK(p.area <= 1.5 * part);
    CHECK(even.size() >= 700 / 1.5);
  }
}

TEST_CASE("SpectrumSurface: pieces of a finer mesh are joined, but not across a thin sheet") {
  const auto count = [](const geom::TriMesh& mesh) {
    return SpectrumSurface(mesh).pieces([part = mesh.area() / 400](const SpectrumPoint&) { return part; });
  };
  const std::size_t joined = count(geom::make_shape("sphere", 60)).size();  // 72,000 facets
  CHECK(joined < 4 * 400);
  CHECK(joined >= 400 / 1.5);
  const auto plate = count(fixtures::box({1, 0.8, 0.002}, 40));
  for (const SurfacePiece& p : plate) {
    if (std::abs(p.at.normal.z()) < 0.5) continue;  // the narrow sides
    CHECK((p.at.position.z() < 0.001) == (p.at.normal.z() < 0));
  }
}

TEST_CASE("SpectrumSurface: a surface without area is refused") {
  const geom::TriMesh line({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)},
                           {{geom::VertexId(0), geom::VertexId(1), geom::VertexId(2)}});
  CHECK_THROWS_AS(SpectrumSurface{line}, geom::InputError);
}
