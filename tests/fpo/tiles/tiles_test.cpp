#include "fpo/tiles/tiles.h"

#include <cmath>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::Box3;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;

TEST_CASE("tiles: the boxes fill space, every sample is in one, every facet in all that it meets") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const auto samples = random_samples(mesh, 300, 4);
    const std::vector<Tile> tiles = make_tiles(mesh, samples, {40, 7});
    CHECK(tiles.size() >= 300 / 40 + 1);
    std::vector<int> times(samples.size(), 0);
    for (std::size_t a = 0; a < tiles.size(); ++a) {
      CHECK(!tiles[a].samples.empty());
      CHECK(tiles[a].samples.size() <= 40);
      CHECK(std::ranges::is_sorted(tiles[a].samples));
      for (const SiteId x : tiles[a].samples) {
        ++times[x.index()];
        CHECK(tiles[a].box.contains(in_frame(tiles[a].frame, samples[x.index()].position)));
        CHECK(tiles[a].sample_box.contains(samples[x.index()].position));
      }
      for (std::size_t b = 0; b < a; ++b)
        CHECK((tiles[a].box.intersection(tiles[b].box).sizes().array() <= 0).any());
      std::vector<FacetId> met;
      for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
        Box3 box;
        for (int i = 0; i < 3; ++i) box.extend(in_frame(tiles[a].frame, mesh.corner(t, i)));
        if (box.intersects(tiles[a].box)) met.push_back(t);
      }
      CHECK(met == tiles[a].facets);
    }
    CHECK(std::ranges::count(times, 1) == 300);
  }
}

TEST_CASE("tiles: all are about as large") {
  const TriMesh mesh = fixtures::blob(12);
  for (const std::size_t n : {1100, 1500, 2000}) {
    const auto samples = random_samples(mesh, n, 3);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(n);
      CAPTURE(seed);
      const std::vector<Tile> tiles = make_tiles(mesh, samples, {n / 3 + 1, seed});  // two cuts deep
      const auto by_size = [](const Tile& a, const Tile& b) { return a.samples.size() < b.samples.size(); };
      const auto [least, most] = std::ranges::minmax_element(tiles, by_size);
      CHECK(least->samples.size() >= n * 13 / 100);  // .4 of .4, or of a third
      CHECK(most->samples.size() <= n / 3 + 1);
      CHECK(tiles.size() >= 4);
      CHECK(tiles.size() <= 5);  // one of .36 is cut again
    }
  }
}

TEST_CASE("tiles: another seed cuts elsewhere, the same seed there again") {
  const TriMesh mesh = fixtures::blob(4);
  const auto samples = random_samples(mesh, 200, 1);
  const auto cut = [&](std::uint64_t seed) {
    return make_tiles(mesh, samples, {.most_samples = 100, .seed = seed}).front().box.max();
  };
  CHECK(cut(1) == cut(1));
  CHECK(cut(1) != cut(2));
}

TEST_CASE("tiles: cuts keep away from samples near which they cost most") {
  const TriMesh mesh = fixtures::blob(4);
  const auto samples = random_samples(mesh, 200, 1);
  std::vector<CutCost> costs(samples.size());
  for (std::size_t i = 0; i < samples.size(); i += 5) costs[i] = {static_cast<double>(i % 7), 0.05};
  // One cut only, and that of the same seed without costs is the first one tried.
  const auto price = [&](std::uint64_t seed, std::span<const CutCost> known) {
    const std::vector<Tile> tiles = make_tiles(mesh, samples, {150, seed, known});
    REQUIRE(tiles.size() == 2);
    int axis = 0;
    while (!std::isfinite(tiles[0].box.max()[axis])) ++axis;
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double at = in_frame(tiles[0].frame, samples[i].position)[axis];
      if (std::abs(at - tiles[0].box.max()[axis]) < costs[i].within) sum += costs[i].cost;
    }
    return sum;
  };
  double aware = 0, unaware = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CHECK(price(seed, costs) <= price(seed, {}));
    aware += price(seed, costs);
    unaware += price(seed, {});
  }
  CHECK(aware < unaware / 2);
  CHECK(unaware > 0);
}

TEST_CASE("tiles: samples at one place stay together") {
  const TriMesh mesh = fixtures::blob(2);
  std::vector<SurfaceSample> samples(50, location_in_facet(mesh, FacetId(0), 0.2, 0.2));
  CHECK(make_tiles(mesh, samples, {.most_samples = 10, .seed = 1}).size() == 1);
  samples.push_back(location_in_facet(mesh, FacetId(0), 0.3, 0.2));
  CHECK(make_tiles(mesh, samples, {.most_samples = 10, .seed = 1}).size() == 2);
}
