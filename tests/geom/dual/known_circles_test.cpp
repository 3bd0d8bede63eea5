#include "geom/dual/known_circles.h"

#include <algorithm>

#include "doctest.h"
#include "geom/check.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/mirrored_dual.h"

using namespace geom;
using fixtures::MirroredDual;
using fixtures::Placed;
using fixtures::Weights;

namespace {

struct Told {
  std::vector<KnownCell> cells;
  std::vector<EmptyCircle> circles;
  std::vector<double> reaches;
  double power = -infinity;
  KnownDiagram all() const { return {cells, circles, reaches, power}; }
  std::size_t num_regular() const {
    return static_cast<std::size_t>(std::ranges::count(cells, CellShape::regular, &KnownCell::shape));
  }
};

/// What a dual finds out about itself, of a share of the sites.
Told told_by(MirroredDual& d, double share, std::uint64_t seed) {
  d.dual().certify();
  Rng rng(seed);
  Told told;
  for (const SiteId p : d.present()) {
    told.cells.push_back(d.dual().known_cell(p));
    if (rng.uniform() >= share) told.cells.back() = {};
    if (told.cells.back().shape == CellShape::unknown) told.cells.back().shape = CellShape::irregular;
    told.reaches.push_back(d.dual().reach_bound(p));
    told.power = std::max(told.power, d.dual().reach_bound(p));
  }
  for (const CircleId c : d.dual().circles()) told.circles.push_back(d.dual().circle(c));
  return told;
}

/// A blob's diagram, divided.
struct Blob {
  explicit Blob(std::size_t n, int k = 6)
      : mesh(fixtures::blob(k)), samples(fixtures::placed_samples(mesh, n, n, Weights::none, 3)) {
    divided.build(samples);
  }
  Blob(const Blob&) = delete;
  TriMesh mesh;
  std::vector<Placed> samples;
  MirroredDual divided{mesh, true, CornerTypes::c_only}, together{mesh, true, CornerTypes::c_only};
};

std::vector<fixtures::NamedSurface> all_surfaces() {
  std::vector<fixtures::NamedSurface> all = fixtures::surfaces();
  for (fixtures::NamedSurface& hard : fixtures::hard_surfaces()) all.push_back(std::move(hard));
  return all;
}

}  // namespace

TEST_CASE("known circles: what is put together from known cells and the rest equals what is divided") {
  std::size_t told = 0;
  for (const auto& [name, mesh] : all_surfaces())
    for (const Weights weights : fixtures::all_weights) {
      CAPTURE(name);
      const std::vector<Placed> samples = fixtures::placed_samples(mesh, 150, 150, weights, 5);
      MirroredDual divided(mesh, true, CornerTypes::c_only);
      divided.build(samples);
      for (const double share : {0.0, 0.5, 0.9, 1.0}) {
        CAPTURE(share);
        const Told known = told_by(divided, share, 7);
        told += known.num_regular();
        MirroredDual together(mesh, true, CornerTypes::c_only);
        together.build(samples, 1, known.all());
        REQUIRE(together.known_circles() == divided.known_circles());
        together.dual().check();
        for (const SiteId p : divided.present()) {
          REQUIRE(together.dual().has_cell(p) == divided.dual().has_cell(p));
          REQUIRE(together.dual().reach_bound(p) >= divided.dual().least_reach(p));
        }
      }
    }
  CHECK(told > 5000);
}

TEST_CASE("known circles: those told twice, and those of no known cell, change nothing") {
  Blob blob(200);
  Told known = told_by(blob.divided, 0.3, 4);
  const std::vector<EmptyCircle> once = known.circles;
  known.circles.insert(known.circles.end(), once.rbegin(), once.rend());
  blob.together.build(blob.samples, 2, known.all());
  CHECK(blob.together.known_circles() == blob.divided.known_circles());
}

TEST_CASE("known circles: a cell told without one of its circles is a bug") {
  Blob blob(200);
  Told known = told_by(blob.divided, 1, 4);
  REQUIRE(known.num_regular() == blob.samples.size());
  known.circles.pop_back();
  CHECK_THROWS_AS(blob.together.build(blob.samples, 1, known.all()), Bug);
}

TEST_CASE("known circles: only the surface near unknown cells is divided") {
  Blob blob(800, 20);
  const auto facets = [&](double share) {
    const Told known = told_by(blob.divided, share, 4);
    DualState state(blob.mesh, CornerTypes::c_only, nullptr);
    for (std::size_t i = 0; i < blob.samples.size(); ++i) state.admit(SiteId(i), blob.samples[i].point);
    return facets_to_divide(known.all(), state).size();
  };
  CHECK(facets(1) == 0);
  CHECK(facets(0.99) < blob.mesh.num_facets() / 2);
  CHECK(facets(0) == blob.mesh.num_facets());
}
