#include "fpo/remesh/small_parts.h"

#include <cmath>

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// A ball of radius 1, and beside it others of radius .03, in a row.
TriMesh ball_and_crumbs(int crumbs) {
  const TriMesh ball = geom::make_shape("sphere", 6);
  TriMesh mesh = ball;
  for (int k = 1; k <= crumbs; ++k)
    mesh = geom::joined(
        mesh, geom::mapped(ball, [&](const Vec3& p) -> Vec3 { return 0.03 * p + Vec3(1.5, 0, 0.2 * k); }));
  return mesh;
}

std::vector<std::size_t> samples_by_part(const geom::SurfaceType& type,
                                         const std::vector<SurfaceSample>& samples) {
  std::vector<std::size_t> counts(type.parts.size(), 0);
  for (const SurfaceSample& x : samples) ++counts[type.part_of[x.facet]];
  return counts;
}

}  // namespace

TEST_CASE("small parts: lengths are lowered on components that call for too few samples, on no other") {
  constexpr std::size_t n = 200;
  const TriMesh mesh = ball_and_crumbs(5);
  const geom::SurfaceType type = geom::surface_type(mesh);
  const Sizing even = fixtures::even(mesh, n);
  const double h = even.at(VertexId(0));
  const std::optional<Sizing> room = SmallParts(mesh).room(even, n, 2);
  REQUIRE(room);
  std::vector<double> demand(type.parts.size(), 0);
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const SurfaceSample middle{(mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3, t};
    demand[type.part_of[t]] += mesh.area(t) / (std::sqrt(0.75) * std::pow(room->at(middle), 2));
    if (type.part_of[t] == 0) {  // a little more: samples come from there
      CHECK(room->at(middle) > h);
      CHECK(room->at(middle) < 1.5 * h);
    }
  }
  for (std::size_t part = 1; part < demand.size(); ++part) {
    CHECK(demand[part] > 6);
    CHECK(demand[part] < 10);
  }
  CHECK(demand[0] < n - 30);
  CHECK(demand[0] > n - 60);

  CHECK(!SmallParts(mesh).room(fixtures::even(mesh, 60000), 60000, 2));  // these are large ones
  const TriMesh alone = ball_and_crumbs(0);
  CHECK(!SmallParts(alone).room(fixtures::even(alone, 5), 5, 2));
  // What cannot be spared is not taken.
  CHECK(!SmallParts(mesh).room(fixtures::even(mesh, n), n, 1.01));
  // Where not all can have eight they have fewer; or some have five.
  const TriMesh many = ball_and_crumbs(20);
  for (const auto& [count, lowered] : {std::pair(170, 20), {100, 15}}) {
    const auto even_many = fixtures::even(many, static_cast<std::size_t>(count));
    const std::optional<Sizing> some = SmallParts(many).room(even_many, static_cast<std::size_t>(count), 2);
    REQUIRE(some);
    int found = 0;
    for (int k = 1; k <= 20; ++k)
      found += some->at(VertexId(static_cast<std::size_t>(k) * (many.num_vertices() / 21))) < 0.5 * h;
    CHECK(found == lowered);
  }
}

TEST_CASE("small parts: samples are put there to begin with, fixed ones stay, those of large ones do") {
  const TriMesh mesh = ball_and_crumbs(3);
  const geom::SurfaceType type = geom::surface_type(mesh);
  const SmallParts parts(mesh);
  const std::optional<Sizing> room = parts.room(fixtures::even(mesh, 100), 100, 2);
  REQUIRE(room);
  const std::vector<SurfaceSample> all_on_one(100, SurfaceSample{mesh.corner(FacetId(0), 0), FacetId(0)});
  std::vector<SurfaceSample> samples = all_on_one;
  parts.people(*room, 10, samples);
  const std::vector<std::size_t> spread = samples_by_part(type, samples);
  for (std::size_t part = 1; part <= 3; ++part) {
    CHECK(spread[part] >= 7);
    CHECK(spread[part] <= 8);
  }
  for (std::size_t i = 0; i < 10; ++i) CHECK(samples[i].facet == FacetId(0));
  for (std::size_t i = 0; i < 100; ++i)  // each at a place of its own
    for (std::size_t j = 0; j < i; ++j)
      if (type.part_of[samples[i].facet] > 0) CHECK(!(samples[i].position == samples[j].position));
  samples = all_on_one;
  parts.people(*room, 90, samples);
  const std::size_t first = spread[1];
  CHECK(samples_by_part(type, samples) ==
        std::vector<std::size_t>{90, first, 10 - first, 0});  // as many as there are
  samples = all_on_one;
  parts.people(fixtures::even(mesh, 100), 10, samples);  // this asks for none there
  CHECK(samples_by_part(type, samples) == std::vector<std::size_t>{100, 0, 0, 0});
}

TEST_CASE("small parts: the remesh has them all, of their type and with good angles") {
  const TriMesh mesh = ball_and_crumbs(12);
  RemeshOptions options = default_options(300, SizingKind::uniform);
  options.optimize.max_iterations = 20;
  for (const SizingKind kind : {SizingKind::uniform, SizingKind::curvature}) {
    options.sizing = kind;
    const RemeshResult result = remesh(mesh, options);
    CHECK(result.mesh.num_vertices() == 300);
    CHECK(result.type.ok());
    CHECK(result.measures.theta_min > 30);
    CHECK(geom::topology(result.mesh).components == 13);
    CHECK(result.thin_parts.faults_before < 12);  // nearly at once
  }
}

TEST_CASE("small parts: nothing is lowered where fixed samples make a body; nobody leaves who is needed") {
  constexpr std::size_t n = 200;
  const TriMesh mesh = ball_and_crumbs(2);
  const geom::SurfaceType type = geom::surface_type(mesh);
  std::vector<SurfaceSample> fixed;
  for (FacetId t(0); t.index() < mesh.num_facets() && fixed.size() < 4; t = FacetId(t.value + 1))
    if (type.part_of[t] == 1) fixed.push_back({mesh.corner(t, 0), t});
  const Sizing even = fixtures::even(mesh, n);
  const std::optional<Sizing> room = SmallParts(mesh).room(even, n, 2, fixed);
  REQUIRE(room);
  const std::size_t of_one = mesh.num_vertices() / 3;
  CHECK(room->at(VertexId(of_one)) > 0.7 * even.at(VertexId(0)));  // beside the other one
  CHECK(room->at(VertexId(2 * of_one)) < 0.5 * even.at(VertexId(0)));

  std::vector<SurfaceSample> samples(12, SurfaceSample{mesh.corner(FacetId(0), 0), FacetId(0)});
  people({mesh, type.part_of, {{1, 8}, {2, 8}}, 0}, samples);
  CHECK(samples_by_part(type, samples) == std::vector<std::size_t>{8, 4, 0});
}
