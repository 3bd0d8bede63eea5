#include "fpo/remesh/finish.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::SiteId;

TEST_CASE("finish: cells that are kept are those of the samples that were moved on the mesh") {
  const geom::TriMesh wedge = geom::make_shape("wedge");
  RemeshOptions options = default_options(250, SizingKind::uniform);
  options.features = automatic_features();
  options.optimize.max_iterations = 5;
  options.improve_fidelity = false;
  options.keep_cells = true;
  const RemeshResult result = remesh(wedge, options);
  REQUIRE(result.finish.last_angles.mended > 0);
  CHECK(result.type.ok());
  std::vector<char> holds_its_sample(result.samples.size(), 0);
  double area = 0;
  for (const CellPolygon& cell : result.cells) {
    if (cell.facet == result.samples[cell.site.index()].facet) holds_its_sample[cell.site.index()] = 1;
    for (std::size_t k = 1; k + 1 < cell.corners.size(); ++k)
      area += (cell.corners[k] - cell.corners[0]).cross(cell.corners[k + 1] - cell.corners[0]).norm() / 2;
  }
  CHECK(area == doctest::Approx(wedge.area()).epsilon(1e-6));
  CHECK(std::ranges::count(holds_its_sample, 1) == 250);
  for (std::size_t i = 0; i < result.samples.size(); ++i)
    CHECK((result.samples[i].position - result.mesh.position(geom::VertexId(i))).norm() < 1e-9);
}
