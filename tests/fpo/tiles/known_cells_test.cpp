#include "fpo/tiles/known_cells.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/remesh/localize.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/tiles/tile_domain.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/power/facet_cells.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::CellShape;
using geom::Vec3;

namespace {

struct Told {
  std::vector<SurfaceSample> samples;
  KnownCells known;
};

/// A round: every tile moves each of its samples some times and tells what it knows.
Told round(const TiledSurface& whole, std::vector<SurfaceSample> samples, int sweeps) {
  Told told{samples, KnownCells(samples.size())};
  for (std::size_t t = 0; t < whole.tiles().size(); ++t) {
    TileDomain tile(whole, t);
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (const SiteId x : whole.tiles()[t].samples) tile.move(x, Scope::global);
    for (const SiteId x : whole.tiles()[t].samples) told.samples[x.index()] = tile.sample(x);
    tile.tell(told.known);
    told.known.raise_power(tile.largest_reach());
  }
  return told;
}

bool is_within(const geom::TriMesh& mesh, geom::FacetId t, const Vec3& x, double radius) {
  return geom::closest_point(x, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}).distance2 <
         radius * radius;
}

struct Count {
  std::size_t regular = 0, sheets = 0;
};

bool is_among(geom::FacetId t, const Tile& tile) { return std::ranges::binary_search(tile.facets, t); }

/// What the tiles of another round are told is so on the whole surface, and is seen by those who tell and
/// those who are told.
Count check(const geom::TriMesh& mesh, const Sizing& sizing, const Told& told, std::span<const Tile> before,
            std::span<const Tile> tiles) {
  const SurfaceDomain domain(mesh, sizing, told.samples, SurfaceOptions());
  const auto diagram = domain.diagram();
  geom::FacetTree facets(mesh, geom::facets_along_curve(mesh));
  const geom::FacetLevels levels(mesh);
  geom::Sheets sheets(mesh, facets, levels);
  std::vector<const Tile*> teller(told.samples.size());
  for (const Tile& tile : before)
    for (const SiteId x : tile.samples) teller[x.index()] = &tile;
  Count count;
  for (const Tile& tile : tiles) {
    const TileGuard guard(tile, 1e-12);
    for (std::size_t i = 0; i < told.samples.size(); ++i) {
      const geom::KnownCell known = told.known.of(SiteId(i), domain.dual().site(SiteId(i)), guard);
      const auto is_seen = [&](geom::FacetId t) { return is_among(t, *teller[i]) && is_among(t, tile); };
      if (known.shape == CellShape::regular) {
        ++count.regular;
        const auto components = cell_components(*diagram, SiteId(i), told.samples[i].facet);
        CHECK(components.size() == 1);
        for (const geom::FragmentId f : components[0]) CHECK(is_seen(diagram->fragments().facet(f)));
      }
      const geom::Sheet& sheet = known.sheet;
      if (!(sheet.width > 0)) continue;
      ++count.sheets;
      const double radius = (1 - 1e-6) * std::hypot(sheet.width, sheet.height);
      CHECK(sheets.sheet_in({sheet.center, 0}, radius).width > 0);
      std::vector<geom::FacetId> near;
      facets.near(sheet.center, radius, near);
      for (const geom::FacetId t : near)
        if (is_within(mesh, t, sheet.center, radius)) CHECK(is_seen(t));
    }
  }
  return count;
}

/// The half-spaces below and above a height.
std::vector<Tile> halves(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples, double z) {
  std::vector<Tile> tiles(2);
  for (Tile& tile : tiles) tile.box = {Vec3::Constant(-1e9), Vec3::Constant(1e9)};
  tiles[0].box.max().z() = tiles[1].box.min().z() = z;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Tile& tile = tiles[samples[i].position.z() < z ? 0 : 1];
    tile.samples.emplace_back(i);
    tile.sample_box.extend(samples[i].position);
  }
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
    geom::Box3 box;
    for (int k = 0; k < 3; ++k) box.extend(mesh.corner(geom::FacetId(t), k));
    if (box.min().z() <= z) tiles[0].facets.emplace_back(t);
    if (box.max().z() >= z) tiles[1].facets.emplace_back(t);
  }
  return tiles;
}

}  // namespace

TEST_CASE("known cells: what tiles tell is so on the whole surface, after moves in all of them") {
  const geom::TriMesh mesh = fixtures::blob(12);
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    constexpr std::size_t n = 1500;
    const Sizing sizing =
        adaptive ? fixtures::graded(mesh, 0.02, 0.02) : Sizing::uniform(hexagonal_spacing(mesh.area(), n));
    const SurfaceOptions options;
    auto samples = random_samples(mesh, sizing, n, 2);
    const TiledSurface whole(mesh, sizing, samples, options, make_tiles(mesh, samples, {500, 3}));
    const Told told = round(whole, samples, 3);
    const Count count = check(mesh, sizing, told, whole.tiles(), make_tiles(mesh, told.samples, {500, 4}));
    CHECK(count.regular > n / 4);
    CHECK(count.sheets > n / 4);
  }
}

TEST_CASE("known cells: a tile told of cells makes the moves that one makes that was told nothing") {
  const geom::TriMesh mesh = fixtures::blob(9);
  const Sizing sizing = fixtures::graded(mesh, 0.03, 0.04);
  const SurfaceOptions options;
  const auto samples = random_samples(mesh, sizing, 900, 2);
  const TiledSurface first(mesh, sizing, samples, options, make_tiles(mesh, samples, {300, 3}));
  const Told told = round(first, samples, 2);
  const std::vector<Tile> tiles = make_tiles(mesh, told.samples, {300, 4});
  const TiledSurface without(mesh, sizing, told.samples, options, tiles);
  TiledSurface with(mesh, sizing, told.samples, options, tiles);
  with.set_known(told.known);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    TileDomain a(with, t), b(without, t);
    for (int sweep = 0; sweep < 3; ++sweep)
      for (const SiteId x : tiles[t].samples) REQUIRE(a.move(x, Scope::global) == b.move(x, Scope::global));
    for (const SiteId x : tiles[t].samples) CHECK(a.sample(x).position == b.sample(x).position);
    a.domain().check();
  }
}

// On a plate thinner than the spacing a sample owns something on both sides. A tile with one of them alone
// sees a disk.
TEST_CASE("known cells: nobody is told of a cell that may go on where the tile ends") {
  constexpr std::size_t n = 400;
  for (const double thickness : {0.02, 1.0}) {
    CAPTURE(thickness);
    const geom::TriMesh mesh = fixtures::box({1, 1, thickness}, 8);
    const Sizing sizing = Sizing::uniform(hexagonal_spacing(mesh.area(), n));
    const SurfaceOptions options;
    auto samples = random_samples(mesh, sizing, n, 2);
    const auto tiles = halves(mesh, samples, 0.5 * thickness + mesh.box().min().z());
    const TiledSurface whole(mesh, sizing, samples, options, tiles);
    const Told told = round(whole, samples, 0);
    const std::vector<Tile> all = make_tiles(mesh, samples, {n, 1});
    REQUIRE(all.size() == 1);
    for (const auto& next : {tiles, all}) {
      const Count count = check(mesh, sizing, told, tiles, next);
      CHECK((count.regular > 0) == (thickness == 1.0));
      CHECK((count.sheets > 0) == (thickness == 1.0));
    }
  }
}
