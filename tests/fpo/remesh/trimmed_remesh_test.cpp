#include "fpo/remesh/trimmed_remesh.h"

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/barycentric.h"
#include "tests/fixtures/sawtooth.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

RemeshOptions plain_options(std::size_t n) {
  RemeshOptions options = default_options(n, SizingKind::uniform);
  options.optimize.max_iterations = 20;
  return options;
}

}  // namespace

TEST_CASE("trimmed remesh: teeth below the spacing cost no angles, and samples are on the whole surface") {
  const TriMesh plate = fixtures::sawtooth_plate(20, 2.4);
  for (const bool with_rho : {false, true}) {
    RemeshOptions options = plain_options(150);
    if (with_rho) {
      options.sizing = SizingKind::given;
      options.rho = VertexField(plate.num_vertices(), 1.0);
      options.rho[VertexId(0)] = 0.7;
    }
    options.keep_cells = true;
    const RemeshResult result = remesh(plate, options);
    CHECK(result.type.ok());
    CHECK(result.mesh.num_vertices() == 150);
    CHECK(result.measures.theta_min >= 30);
    CHECK(result.given_up.find("teeth of borders cut off: 9 facets") != std::string::npos);
    REQUIRE(result.sizing.size() == plate.num_vertices());
    for (const double h : result.sizing) CHECK(h > 0);
    for (const Vec3& weights : barycentric_coordinates(plate, result.samples)) {
      CHECK(weights.minCoeff() > -1e-9);
      CHECK(weights.maxCoeff() < 1 + 1e-9);
    }
    for (std::size_t i = 0; i < result.samples.size(); ++i) {
      CHECK(result.samples[i].facet < FacetId(800));  // no sample is on a tooth
      CHECK(result.samples[i].position == result.mesh.position(VertexId(i)));
    }
    REQUIRE(!result.cells.empty());
    for (const CellPolygon& cell : result.cells) CHECK(cell.facet < FacetId(800));
  }
}

TEST_CASE("trimmed remesh: not where features are asked for, nor where it is no use") {
  const TriMesh plate = fixtures::sawtooth_plate(20, 2.4);
  RemeshOptions options = plain_options(150);
  std::size_t remeshes = 0;
  double theta = 20;
  bool is_of_type = true;
  const auto remesh = [&](const TriMesh& surface, const RemeshOptions&) {
    ++remeshes;
    RemeshResult result;
    result.measures.theta_min = theta;
    result.measures.angles_below_30 = theta < 30 ? 3 : 0;
    if (!is_of_type) result.type.bare_samples = 1;
    result.sizing = VertexField(surface.num_vertices(), 1.0);
    return result;
  };
  CHECK(remesh_trimmed_or_not(plate, options, remesh).given_up.empty());  // the other one is no better
  CHECK(remeshes == 2);
  theta = 30;
  remesh_trimmed_or_not(plate, options, remesh);
  CHECK(remeshes == 3);  // it is good as it is
  is_of_type = false;
  remesh_trimmed_or_not(plate, options, remesh);
  CHECK(remeshes == 5);
  options.features->yielding = false;
  remesh_trimmed_or_not(plate, options, remesh);
  CHECK(remeshes == 6);

  // What n is too small for, and what is interrupted, leave the first one.
  options = plain_options(150);
  const auto refusing = [&](const TriMesh& surface, const RemeshOptions& how) {
    if (surface.num_facets() < plate.num_facets()) throw geom::InputError("too few");
    return remesh(surface, how);
  };
  CHECK(remesh_trimmed_or_not(plate, options, refusing).type.bare_samples == 1);
}
