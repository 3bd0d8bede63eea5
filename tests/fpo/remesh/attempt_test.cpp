#include "fpo/remesh/attempt.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/remesh/remesh_task.h"
#include "tests/fixtures/block.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

TEST_CASE("attempt: no samples on an edge that is no crease, also where others are close to each other") {
  const TriMesh plate = fixtures::block(10, 4, 0.3);
  RemeshOptions options;
  options.num_samples = 400;
  options.optimize.max_iterations = 5;
  options.features = FeatureOptions();
  const Vec3 from(0, 4, 0.3), to(10, 4, 0.3);
  const auto on_edge = [&] {
    const FeatureChoice choice = chosen_features(plate, options);
    REQUIRE(helpful_narrow_surface(plate, choice.features, part_sizing(plate, choice.features, options),
                                   options));
    const RemeshResult result = attempted_remesh(plate, choice, options, {}, {});
    return std::count_if(
        result.samples.begin(), result.samples.begin() + static_cast<std::ptrdiff_t>(result.feature_samples),
        [&](const SurfaceSample& x) {
          const double along = x.position.x();
          return along > 0.5 && along < 9.5 && (x.position - Vec3(along, from.y(), from.z())).norm() < 1e-9;
        });
  };
  CHECK(on_edge() > 10);
  for (geom::VertexId a(0); a.index() < plate.num_vertices(); a = geom::VertexId(a.value + 1))
    for (geom::VertexId b(0); b.index() < plate.num_vertices(); b = geom::VertexId(b.value + 1))
      if (plate.position(a) == from && plate.position(b) == to) options.features->unmarked.push_back({a, b});
  REQUIRE(options.features->unmarked.size() == 1);
  CHECK(on_edge() == 0);
}
