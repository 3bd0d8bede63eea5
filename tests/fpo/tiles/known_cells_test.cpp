#include "fpo/tiles/known_cells.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/remesh/cell_faults.h"
#include "fpo/remesh/localize.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/tiles/tile_domain.h"
#include "geom/mesh/aabb_tree.h"
#include "tests/fixtures/sheet_scene.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace fpo;
using geom::CellShape;
using geom::Vec3;

namespace {

struct Told {
  std::vector<SurfaceSample> samples;
  KnownCells known;
};

/// The whole surface moves each sample some times and tells what it knows.
Told by_whole(const geom::TriMesh& mesh, const Sizing& sizing, std::vector<SurfaceSample> samples,
              int sweeps) {
  SurfaceDomain domain(mesh, sizing, samples);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < samples.size(); ++i) domain.move(SiteId(i), Scope::global);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = domain.sample(SiteId(i));
  return {std::move(samples), KnownCells(domain.dual())};
}

/// A round: every tile moves each of its samples some times and tells what it knows.
Told round(const TiledSurface& whole, std::vector<SurfaceSample> samples, int sweeps) {
  Told told{samples, KnownCells(samples.size(), whole.tiles().size())};
  for (std::size_t t = 0; t < whole.tiles().size(); ++t) {
    TileDomain tile(whole, t);
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (const SiteId x : whole.tiles()[t].samples) tile.move(x, Scope::global);
    for (const SiteId x : whole.tiles()[t].samples) told.samples[x.index()] = tile.sample(x);
    tile.tell(told.known);
    told.known.raise_power(tile.largest_reach());
  }
  told.known.end_round();
  return told;
}

bool is_within(const geom::TriMesh& mesh, geom::FacetId t, const Vec3& x, double radius) {
  return geom::closest_point(x, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}).distance2 <
         radius * radius;
}

struct Count {
  std::size_t regular = 0, sheets = 0;
};

/// What those are told who go on is compared with the whole surface, looked at afresh.
class Afresh {
 public:
  /// `before`: the tiles that told it; none if the whole surface did. Keeps references.
  Afresh(const geom::TriMesh& mesh, const Sizing& sizing, const Told& told, std::span<const Tile> before)
      : surface_(mesh),
        told_(told),
        domain_(mesh, sizing, told.samples),
        diagram_(domain_.diagram()),
        no_disk_(told.samples.size(), false),
        teller_(told.samples.size(), nullptr) {
    for (const CellFault& fault : cell_faults(*diagram_, {}))
      if (!fault.other.valid()) no_disk_[fault.cell.index()] = true;
    for (const Tile& tile : before)
      for (const SiteId x : tile.samples) teller_[x.index()] = &tile;
  }

  std::size_t num_no_disk() const { return static_cast<std::size_t>(std::ranges::count(no_disk_, true)); }

  /// What tiles are told is so on the whole surface, and is seen by those who tell and those who are told.
  Count check_tiles(std::span<const Tile> tiles) {
    count_ = {};
    for (const Tile& tile : tiles) {
      const TileGuard guard(tile, 1e-12);
      for (SiteId x(0); x.index() < told_.samples.size(); x = SiteId(x.value + 1))
        check(x, told_.known.of(x, domain_.dual().site(x), guard), &tile);
    }
    return count_;
  }

  /// The same of what the whole surface is told.
  Count check_whole() {
    count_ = {};
    const std::vector<geom::KnownCell> known = told_.known.of_all(domain_.samples());
    REQUIRE(known.size() == told_.samples.size());
    for (std::size_t i = 0; i < known.size(); ++i) check(SiteId(i), known[i], nullptr);
    return count_;
  }

 private:
  /// Null: the whole surface.
  static bool sees(const Tile* tile, geom::FacetId t) {
    return !tile || std::ranges::binary_search(tile->facets, t);
  }

  /// Where a facet begins at just that radius, that may be more than is sure; a little less is not.
  bool is_sheet(const Vec3& center, double radius) {
    return surface_.sheets.sheet_in({center, 0}, radius).width > 0 ||
           surface_.sheets.sheet_in({center, 0}, (1 - 1e-5) * radius).width > 0;
  }

  void check(SiteId x, const geom::KnownCell& known, const Tile* told) {
    CAPTURE(x.value);
    const auto is_seen = [&](geom::FacetId t) { return sees(teller_[x.index()], t) && sees(told, t); };
    if (known.shape == CellShape::regular) {
      ++count_.regular;
      const auto components = cell_components(*diagram_, x, told_.samples[x.index()].facet);
      CHECK(components.size() == 1);
      CHECK_FALSE(no_disk_[x.index()]);
      for (const geom::FragmentId f : components[0]) CHECK(is_seen(diagram_->fragments().facet(f)));
    }
    const geom::Sheet& sheet = known.sheet;
    if (!(sheet.width > 0)) return;
    ++count_.sheets;
    const double radius = (1 - 1e-6) * std::hypot(sheet.width, sheet.height);
    CHECK(is_sheet(sheet.center, radius));
    std::vector<geom::FacetId> near;
    surface_.facets.near(sheet.center, radius, near);
    for (const geom::FacetId t : near)
      if (is_within(surface_.mesh, t, sheet.center, radius)) CHECK(is_seen(t));
  }

  fixtures::SheetScene surface_;
  const Told& told_;
  SurfaceDomain domain_;
  std::unique_ptr<geom::RestrictedPower> diagram_;
  std::vector<bool> no_disk_;        ///< whose cell is none
  std::vector<const Tile*> teller_;  ///< whose tile each sample was in
  Count count_;
};

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

struct Case {
  const geom::TriMesh& mesh;
  Sizing sizing;
  std::size_t n;  ///< samples
};

/// The circles of a domain and who is beyond them, ids left out.
auto circles_of(const SurfaceDomain& domain) {
  std::vector<SiteId> all;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) all.emplace_back(i);
  return oracle::circles_of(domain.dual(), all);
}

/// Of these samples, some sweeps.
template <class Domain, class Move>
void check_same_moves(Domain& a, Domain& b, std::span<const SiteId> samples, Move move) {
  for (int sweep = 0; sweep < 3; ++sweep)
    for (const SiteId x : samples) REQUIRE(move(a, x) == move(b, x));
  for (const SiteId x : samples) CHECK(a.sample(x).position == b.sample(x).position);
}

}  // namespace

TEST_CASE("known cells: what tiles tell is so on the whole surface, after moves in all of them") {
  const geom::TriMesh mesh = fixtures::blob(12);
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    constexpr std::size_t n = 1500;
    const Sizing sizing = adaptive ? fixtures::graded(mesh, 0.02, 0.02) : fixtures::even(mesh, n);
    const SurfaceOptions options;
    auto samples = random_samples(mesh, sizing, n, 2);
    const TiledSurface whole(mesh, sizing, samples, options, make_tiles(mesh, samples, {500, 3}));
    const Told told = round(whole, samples, 3);
    Afresh afresh(mesh, sizing, told, whole.tiles());
    for (const Count& count :
         {afresh.check_tiles(make_tiles(mesh, told.samples, {500, 4})), afresh.check_whole()}) {
      CHECK(count.regular > n / 4);
      CHECK(count.sheets > n / 4);
    }
  }
}

TEST_CASE("known cells: what the whole surface tells is so, for itself and for tiles") {
  constexpr std::size_t n = 600;
  const geom::TriMesh blob = fixtures::blob(9);
  // On the thin plate samples own something on both sides.
  const geom::TriMesh plate = fixtures::box({1, 1, 0.02}, 8);
  for (const Case& c : {Case{blob, fixtures::even(blob, n), n},
                        {blob, fixtures::graded(blob, 0.03, 0.03), n},
                        {plate, fixtures::even(plate, n), n}}) {
    CAPTURE(c.mesh.num_facets());
    const Told told = by_whole(c.mesh, c.sizing, random_samples(c.mesh, c.sizing, n, 2), 2);
    Afresh afresh(c.mesh, c.sizing, told, {});
    CHECK((afresh.num_no_disk() > n / 4) == (&c.mesh == &plate));
    const Count whole = afresh.check_whole();
    const Count tiles = afresh.check_tiles(make_tiles(c.mesh, told.samples, {200, 4}));
    if (&c.mesh == &plate) continue;
    CHECK(whole.regular > n - n / 50);
    CHECK(whole.sheets > n / 2);
    CHECK(tiles.regular > n / 4);
    CHECK(tiles.sheets > n / 4);
  }
}

TEST_CASE("known cells: who is told of cells makes the moves that are made by who was told nothing") {
  const geom::TriMesh blob = fixtures::blob(9), plate = fixtures::box({1, 1, 0.02}, 8),
                      islands = fixtures::islands();
  const SurfaceOptions options;
  for (const Case& c : {Case{blob, fixtures::graded(blob, 0.03, 0.04), 900},
                        {plate, fixtures::even(plate, 900), 900},
                        {islands, fixtures::even(islands, 60), 60}}) {
    CAPTURE(c.mesh.num_facets());
    const auto samples = random_samples(c.mesh, c.sizing, c.n, 2);
    const TiledSurface first(c.mesh, c.sizing, samples, options, make_tiles(c.mesh, samples, {c.n / 3, 3}));
    for (const Told& told : {round(first, samples, 2), by_whole(c.mesh, c.sizing, samples, 1)}) {
      const std::vector<Tile> tiles = make_tiles(c.mesh, told.samples, {c.n / 3, 4});
      const TiledSurface without(c.mesh, c.sizing, told.samples, options, tiles);
      TiledSurface with(c.mesh, c.sizing, told.samples, options, tiles);
      with.set_known(told.known);
      for (std::size_t t = 0; t < tiles.size(); ++t) {
        TileDomain a(with, t), b(without, t);
        CHECK(circles_of(a.domain()) == circles_of(b.domain()));
        const auto move = [](TileDomain& tile, SiteId x) { return tile.move(x, Scope::global); };
        check_same_moves(a, b, tiles[t].samples, move);
        a.domain().check();
      }
      std::vector<SiteId> all;
      for (std::size_t i = 0; i < c.n; ++i) all.emplace_back(i);
      SurfaceOptions knowing = options;
      const std::vector<geom::KnownCell> known = told.known.of_all({c.sizing, told.samples, options});
      knowing.known = {known, told.known.circles(), told.known.reaches(), told.known.power()};
      SurfaceDomain a(c.mesh, c.sizing, told.samples, knowing), b(c.mesh, c.sizing, told.samples, options);
      CHECK(circles_of(a) == circles_of(b));
      const auto move = [](SurfaceDomain& whole, SiteId x) { return whole.move(x, Scope::global); };
      check_same_moves(a, b, all, move);
      a.check();
    }
  }
}

// On a plate thinner than the spacing a sample owns something on both sides. A tile with one of them alone
// sees a disk.
TEST_CASE("known cells: nobody is told of a cell that may go on where the tile ends") {
  constexpr std::size_t n = 400;
  for (const double thickness : {0.02, 1.0}) {
    CAPTURE(thickness);
    const geom::TriMesh mesh = fixtures::box({1, 1, thickness}, 8);
    const Sizing sizing = fixtures::even(mesh, n);
    const SurfaceOptions options;
    auto samples = random_samples(mesh, sizing, n, 2);
    const auto tiles = halves(mesh, samples, 0.5 * thickness + mesh.box().min().z());
    const TiledSurface whole(mesh, sizing, samples, options, tiles);
    const Told told = round(whole, samples, 0);
    const std::vector<Tile> all = make_tiles(mesh, samples, {n, 1});
    REQUIRE(all.size() == 1);
    for (const auto& next : {tiles, all}) {
      const Count count = Afresh(mesh, sizing, told, tiles).check_tiles(next);
      CHECK((count.regular > 0) == (thickness == 1.0));
      CHECK((count.sheets > 0) == (thickness == 1.0));
    }
    const Count count = Afresh(mesh, sizing, told, tiles).check_whole();
    CHECK((count.regular > 0) == (thickness == 1.0));
    CHECK((count.sheets > 0) == (thickness == 1.0));
  }
}
