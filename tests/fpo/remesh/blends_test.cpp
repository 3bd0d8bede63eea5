#include "fpo/remesh/blends.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/measure/hausdorff.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double gradation = 0.18;

std::optional<Sizing> beside_blends(const TriMesh& mesh, std::size_t n) {
  return sizing_beside_blends(mesh, find_features(mesh), n, gradation);
}

/// On one of the two fillets of the shaft, which have a radius of .02.
bool is_on_fillet(const Vec3& x) {
  constexpr double far = 1e-6;
  const double r = std::hypot(x.x(), x.y());
  const double lower = std::hypot(r - 0.32, x.z() - 0.58), upper = std::hypot(r - 0.37, x.z() - 1.02);
  return (r < 0.32 + far && x.z() > 0.58 - far && std::abs(lower - 0.02) < far) ||
         (r < 0.37 + far && x.z() < 1.02 + far && std::abs(upper - 0.02) < far);
}

}  // namespace

TEST_CASE("blends: lengths are less on fillets finer than the spacing, graded, and call for n samples") {
  const TriMesh mesh = geom::make_shape("shaft");
  for (const std::size_t n : {1000u, 6000u}) {
    CAPTURE(n);
    const std::optional<Sizing> sizing = beside_blends(mesh, n);
    REQUIRE(sizing);
    const double spacing = hexagonal_spacing(mesh.area(), n);
    double most_on_fillet = 0, most = 0, least = spacing;
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1)) {
      const double h = sizing->at(v);
      most = std::max(most, h), least = std::min(least, h);
      if (is_on_fillet(mesh.position(v))) most_on_fillet = std::max(most_on_fillet, h);
    }
    CHECK(most_on_fillet > 0);
    CHECK(most_on_fillet < 0.9 * spacing);
    CHECK(least > 0.7 * spacing);
    CHECK(most < 1.1 * spacing);
    CHECK(num_samples(mesh, *sizing) == doctest::Approx(static_cast<double>(n)).epsilon(0.01));
    for (const TriMesh::Facet& f : mesh.facets())
      for (std::size_t e = 0; e < 3; ++e) {
        const VertexId a = f[e], b = f[(e + 1) % 3];
        const double length = (mesh.position(a) - mesh.position(b)).norm();
        CHECK(std::abs(sizing->at(a) - sizing->at(b)) <= (gradation + 1e-9) * length);
      }
  }
}

TEST_CASE("blends: none where nothing bends so much, where there are no creases, and at tips") {
  CHECK(!beside_blends(geom::make_shape("shaft"), 40000));  // fillets are wider than the spacing
  for (const char* name : {"cube", "cylinder", "joint", "star", "gear"}) {
    CAPTURE(name);
    CHECK(!beside_blends(geom::make_shape(name), 2000));
  }
  CHECK(!sizing_beside_blends(geom::make_shape("shaft"), {}, 2000, gradation));
  CHECK(!beside_blends(geom::make_shape("cone-plate"), 2000));  // a tip is no band
}

TEST_CASE("blends: the remesh of a shaft is nearer to it with exactly n vertices and good angles") {
  const TriMesh mesh = geom::make_shape("shaft", 32);
  RemeshOptions options = default_options(1500, SizingKind::uniform);
  options.optimize.max_iterations = 5;
  options.improve_fidelity = false;
  const RemeshResult with = remesh(mesh, options);
  options.mend = false;
  const RemeshResult without = remesh(mesh, options);
  CHECK(with.mesh.num_vertices() == 1500);
  CHECK(with.type.ok());
  CHECK(with.broken_feature_edges == 0);
  CHECK(with.measures.theta_min > 30);
  CHECK(surface_distance(with.mesh, mesh).max < 0.9 * surface_distance(without.mesh, mesh).max);
}
