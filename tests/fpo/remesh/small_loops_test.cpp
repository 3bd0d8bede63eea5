#include "fpo/remesh/small_loops.h"

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"

using namespace fpo;
using geom::TriMesh;

namespace {

SharedSizing shared_for(const TriMesh& mesh, std::size_t n) {
  FeatureOptions options = automatic_features();
  options.turn_scale = hexagonal_spacing(mesh.area(), n) / 2;
  const auto sizing_for = [&](std::size_t count) { return fixtures::even(mesh, count); };
  return share_sizing(mesh, find_features(mesh, options), {}, sizing_for, {n});
}

}  // namespace

TEST_CASE("small loops: borders of three short edges want short edges around, others nothing") {
  const TriMesh holes = geom::make_shape("pin-holes", 24), tube = geom::make_shape("tube", 24);
  const SharedSizing shared = shared_for(holes, 300);
  const SmallLoops found = make_room_for_small_loops(holes, shared, 300, {0.3, 2});
  CHECK(found.loops == 5);
  CHECK(!found.sizing.is_uniform());
  const double h = shared.sizing.at(geom::VertexId(0));
  double least = h, most = 0;
  for (std::size_t v = 0; v < holes.num_vertices(); ++v) {
    least = std::min(least, found.sizing.at(geom::VertexId(v)));
    most = std::max(most, found.sizing.at(geom::VertexId(v)));
  }
  CHECK(least < 0.5 * h);
  CHECK(most > h);  // elsewhere samples are fewer
  CHECK(most < 2 * h);

  CHECK(make_room_for_small_loops(tube, shared_for(tube, 300), 300, {0.3, 2}).loops == 0);
  CHECK(make_room_for_small_loops(tube, shared_for(tube, 300), 300, {0.3, 2}).sizing.is_uniform());
  // With few samples none can be spared.
  CHECK(make_room_for_small_loops(holes, shared_for(holes, 30), 30, {0.3, 1.01}).sizing.is_uniform());
}

TEST_CASE("small loops: the remesh keeps pin-holes, with good angles around them") {
  RemeshOptions options = default_options(300, SizingKind::uniform);
  options.optimize.max_iterations = 20;
  const RemeshResult result = remesh(geom::make_shape("pin-holes", 12), options);
  CHECK(result.mesh.num_vertices() == 300);
  CHECK(result.type.ok());
  CHECK(geom::topology(result.mesh).boundary_loops == 5);
  options.mend = false;
  const double without = remesh(geom::make_shape("pin-holes", 12), options).measures.theta_min;
  CHECK(result.measures.theta_min > 27);
  CHECK(without < 25);
}

TEST_CASE("small loops: lengths that follow the shape are lowered around loops of three edges") {
  const TriMesh holes = geom::make_shape("pin-holes", 12);
  for (const SizingKind kind : {SizingKind::local_feature_size, SizingKind::curvature}) {
    RemeshOptions options = default_options(300, kind);
    options.optimize.max_iterations = 20;
    const RemeshResult result = remesh(holes, options);
    CHECK(result.mesh.num_vertices() == 300);
    CHECK(result.type.ok());
    CHECK(geom::topology(result.mesh).boundary_loops == 5);
    options.mend = false;
    CHECK(result.measures.theta_min > remesh(holes, options).measures.theta_min + 3);
  }
  const SharedSizing shared = shared_for(holes, 300);
  CHECK(make_room_for_small_loops(holes, shared, 300, {0.3, 2, 2}).loops == 0);
  CHECK(make_room_for_small_loops(holes, shared, 300, {0.3, 2, 3}).loops == 5);
}

TEST_CASE("small loops: two chains between the same corners make one, a chain alone makes none") {
  const TriMesh plate = geom::make_shape("cube", 4);
  SharedSizing shared{Sizing::uniform(0.2 * plate.diagonal()), {}};
  const double side = 0.01 * plate.diagonal();
  const geom::Vec3 at = plate.corner(geom::FacetId(0), 0);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 1), std::pair(1, 0), std::pair(0, 1)})
    shared.features.samples.push_back({at + side * geom::Vec3(x, y, 0), geom::FacetId(0)});
  using geom::SiteId;
  shared.features.chains = {{SiteId(0), SiteId(2), SiteId(1)}};
  CHECK(make_room_for_small_loops(plate, shared, 300, {0.3, 2}).loops == 0);
  for (const std::vector<SiteId>& other :
       {std::vector{SiteId(0), SiteId(3), SiteId(1)}, std::vector{SiteId(1), SiteId(3), SiteId(0)}}) {
    shared.features.chains.resize(1);
    shared.features.chains.push_back(other);
    CHECK(make_room_for_small_loops(plate, shared, 300, {0.3, 2}).loops == 1);
  }
}
