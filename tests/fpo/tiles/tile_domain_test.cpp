#include "fpo/tiles/tile_domain.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;

namespace {

struct Move {
  SiteId x;
  double separation;
  bool moved;
  SurfaceSample place;
};

/// What a tile does in some sweeps, by itself.
std::vector<Move> moves_in(const TiledSurface& whole, std::size_t tile, Scope scope) {
  TileDomain domain(whole, tile);
  std::vector<Move> moves;
  for (int sweep = 0; sweep < 3; ++sweep)
    for (const SiteId x : whole.tiles()[tile].samples) {
      if (x.index() < whole.options().num_fixed) continue;
      const SurfaceSample old = domain.sample(x);
      SiteId here(0);
      while (domain.whole_id(here) != x) here = SiteId(here.value + 1);
      const double separation = domain.domain().dual().nearest(old.position, here).radius2;
      const MoveOutcome outcome = domain.move(x, scope);
      const SurfaceSample now = domain.sample(x);
      const bool moved = outcome == MoveOutcome::moved;
      if (!moved) CHECK(now.position == old.position);
      if (!moved) CHECK(now.facet == old.facet);
      if (outcome != MoveOutcome::forbidden) moves.push_back({x, separation, moved, now});
    }
  domain.domain().check();
  return moves;
}

/// The circle of the whole diagram at that place.
CircleId circle_at(const SurfaceDomain& domain, const SurfaceSample& place) {
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    for (const CircleId c : domain.dual().circles_of(SiteId(i)))
      if (domain.dual().circle(c).center == place.position && domain.dual().circle(c).facet == place.facet)
        return c;
  return {};
}

/// Makes the move on the whole surface and checks that it is what Algorithm 1 does there.
void replay(SurfaceDomain& whole, const Move& move, Scope scope) {
  REQUIRE(whole.separation(move.x) == move.separation);
  whole.remove(move.x);
  Circle c = whole.largest_empty(scope);
  if (scope == Scope::two_ring) {
    REQUIRE((c.radius2 > move.separation) == move.moved);
    if (move.moved) REQUIRE(whole.dual().circle(c.id).center == move.place.position);
    if (move.moved) REQUIRE(whole.dual().circle(c.id).facet == move.place.facet);
  } else if (move.moved) {
    const double largest = c.radius2;
    c.id = circle_at(whole, move.place);
    REQUIRE(c.id.valid());
    c.radius2 = whole.dual().circle(c.id).radius2;
    REQUIRE(c.radius2 <= largest);
    REQUIRE(c.radius2 > move.separation);
  }
  if (move.moved)
    whole.insert_at(move.x, c);
  else
    whole.put_back(move.x);
}

/// The tiles' moves one tile after the other, the last one first, or interleaved at random.
std::vector<Move> merged(const std::vector<std::vector<Move>>& tiles, int way) {
  std::vector<Move> result;
  if (way < 2) {
    for (std::size_t i = 0; i < tiles.size(); ++i)
      for (const Move& move : tiles[way == 0 ? i : tiles.size() - 1 - i]) result.push_back(move);
    return result;
  }
  std::vector<std::size_t> owners, next(tiles.size(), 0);
  for (std::size_t i = 0; i < tiles.size(); ++i) owners.insert(owners.end(), tiles[i].size(), i);
  geom::Rng(5).shuffle(std::span(owners));
  for (const std::size_t i : owners) result.push_back(tiles[i][next[i]++]);
  return result;
}

}  // namespace

TEST_CASE("tile domain: the moves of all tiles are moves on the whole surface, in any order") {
  int combination = 0;
  for (const auto& surface : {fixtures::NamedSurface{"blob", fixtures::blob(9)},
                              {"box", fixtures::box({1, 1, 1}, 6)},
                              {"square", fixtures::tilted_square(12)}}) {
    for (const bool adaptive : {false, true})
      for (const Scope scope : {Scope::two_ring, Scope::global}) {
        ++combination;
        CAPTURE(surface.name);
        const TriMesh& mesh = surface.mesh;
        CAPTURE(adaptive);
        CAPTURE(combination);
        constexpr std::size_t n = 900;
        SurfaceOptions options;
        options.corners = combination % 3 == 0 ? geom::CornerTypes::all : geom::CornerTypes::c_only;
        options.engine = combination % 4 == 0 ? Engine::triangulation : Engine::search;
        options.num_fixed = 20;
        const Sizing sizing = adaptive ? fixtures::graded(mesh, 0.03, 0.04) : fixtures::even(mesh, n);
        const auto samples = random_samples(mesh, sizing, n, 2);
        const TiledSurface whole(mesh, sizing, samples, options, make_tiles(mesh, samples, {250, 3}));
        std::vector<std::vector<Move>> tiles;
        std::size_t moved = 0;
        for (std::size_t t = 0; t < whole.tiles().size(); ++t) {
          tiles.push_back(moves_in(whole, t, scope));
          moved += static_cast<std::size_t>(std::ranges::count(tiles.back(), true, &Move::moved));
        }
        CHECK(moved > n / 8);
        SurfaceDomain domain(mesh, sizing, samples, options);
        for (const Move& move : merged(tiles, combination % 3)) replay(domain, move, scope);
        domain.check();
      }
  }
}

TEST_CASE("tile domain: its diagram is that of the whole on its facets") {
  const TriMesh mesh = fixtures::blob(8);
  const Sizing sizing = fixtures::graded(mesh, 0.03, 0.04);
  const auto samples = random_samples(mesh, sizing, 500, 6);
  const SurfaceOptions options;
  const SurfaceDomain domain(mesh, sizing, samples, options);
  const auto expected = domain.diagram()->canonical();
  const TiledSurface whole(mesh, sizing, samples, options, make_tiles(mesh, samples, {120, 1}));
  for (std::size_t t = 0; t < whole.tiles().size(); ++t) {
    const TileDomain tile(whole, t);
    CHECK(tile.domain().num_samples() < samples.size());
    std::vector<geom::RestrictedPower::Canonical> inside, found = tile.domain().diagram()->canonical();
    for (const auto& fragment : expected)
      if (std::ranges::binary_search(whole.tiles()[t].facets, fragment.facet)) inside.push_back(fragment);
    for (auto& fragment : found) {
      fragment.facet = tile.whole_id(fragment.facet);
      fragment.site = tile.whole_id(fragment.site);
      for (geom::EdgeLabel& label : fragment.labels)
        if (label.is_site()) label = geom::EdgeLabel::bisector(tile.whole_id(label.site()));
    }
    CHECK(found == inside);
  }
}
