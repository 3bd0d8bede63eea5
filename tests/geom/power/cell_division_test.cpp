// The division of cells of all shapes against its definition.

#include "geom/power/cell_division.h"

#include <algorithm>

#include "doctest.h"
#include "geom/power/restricted_power.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;
using fixtures::Weights;

namespace {

struct KnownShare {
  RestrictedPower::Canonical polygon;
  FragmentId joins;
  auto operator<=>(const KnownShare&) const = default;
};

RestrictedPower::Canonical canonical(const FacetPolygon& polygon) {
  RestrictedPower::Canonical result{polygon.facet, polygon.owner, {}};
  for (const PolygonCorner& corner : polygon.corners) result.labels.push_back(corner.edge);
  std::rotate(result.labels.begin(), std::ranges::min_element(result.labels), result.labels.end());
  return result;
}

std::vector<KnownShare> shares_of(CellDivision& division) {
  std::vector<KnownShare> result;
  for (const CellDivision::Share& share : division.shares())
    result.push_back({canonical(share.polygon), share.joins});
  std::ranges::sort(result);
  return result;
}

/// { x in t : p beats k at x, and k beats every other heir at x }, and what it continues across p's border.
std::vector<KnownShare> shares_by_definition(Clipper& clipper, const FragmentStore& fragments, SiteId p,
                                             std::span<const FragmentId> cell,
                                             std::span<const SiteId> heirs) {
  std::vector<KnownShare> result;
  FacetPolygon polygon;
  for (const FragmentId f : cell)
    for (const SiteId k : heirs) {
      clipper.start(polygon, fragments.facet(f), k);
      clipper.clip_beyond(polygon, p, clipper.bisector_of(k, p));
      for (const SiteId h : heirs)
        if (h != k && !polygon.corners.empty()) clipper.clip(polygon, h);
      if (polygon.corners.empty()) continue;
      const bool borders =
          std::ranges::count(polygon.corners, EdgeLabel::bisector(p), &PolygonCorner::edge) > 0;
      result.push_back({canonical(polygon), borders ? fragments.find(k, fragments.facet(f)) : FragmentId()});
    }
  std::ranges::sort(result);
  return result;
}

struct Count {
  int cells = 0, shares = 0, strangers = 0;
};

/// A diagram of n sites; each cell is divided among the heirs that its labels name, and among all sites.
void divide_all_cells(const TriMesh& mesh, std::size_t n, Weights kind, std::uint64_t seed, Count& count) {
  const std::vector<WeightedPoint3> points = points_of(fixtures::placed_samples(mesh, n, n, kind, seed));
  const Clipper::Sites sites(points.begin(), points.end());
  SiteTree tree;
  for (std::size_t i = 0; i < n; ++i) tree.insert(SiteId(i), points[i]);
  const RestrictedPower power(mesh, points, tree);
  Clipper clipper(mesh, sites, extent_of(mesh));
  CellDivision division(clipper, power.fragments());
  for (SiteId p(0); p.index() < n; p = SiteId(p.value + 1)) {
    const std::span<const FragmentId> fragments = power.fragments().of_cell(p);
    const std::vector<FragmentId> cell(fragments.begin(), fragments.end());
    CellHeirs& heirs = division.heirs();
    for (const bool all : {false, true}) {
      division.begin(p, cell);
      for (SiteId j(0); j.index() < n; j = SiteId(j.value + 1))
        if (heirs.is_stranger(j) && (all || (heirs.size() == 0 && j != p))) heirs.add(j);
      division.divide();
      CHECK(!division.misfit());
      const std::vector<KnownShare> shares = shares_of(division);
      CHECK(shares == shares_by_definition(clipper, power.fragments(), p, cell, heirs.sites()));
      for (SiteId j(0); j.index() < n; j = SiteId(j.value + 1)) {
        if (all && j != p) CHECK(!division.is_missing(j));
        count.strangers += !all && heirs.is_stranger(j) && division.is_missing(j);
      }
      count.cells += !cell.empty();
      count.shares += static_cast<int>(shares.size());
    }
  }
}

}  // namespace

TEST_CASE("cell division: each heir's share is what it has if the site is left out") {
  Count count;
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    for (const Weights kind : fixtures::all_weights)
      for (const std::size_t n : {5u, 30u, 120u}) divide_all_cells(surface.mesh, n, kind, n + 3, count);
  }
  CHECK(count.cells > 1000);
  CHECK(count.shares > 4 * count.cells);
  CHECK(count.strangers > 20);  // heirs that no label names: across a thin plate, or hidden until then
}

TEST_CASE("cell division: the corners of large facets, where an heir meets the boundary twice") {
  Count count;
  const TriMesh needles(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0.05, 0), Vec3(0, 0.05, 0), Vec3(0.5, 0.02, 0.01)},
      {{VertexId(0), VertexId(1), VertexId(4)},
       {VertexId(1), VertexId(2), VertexId(4)},
       {VertexId(2), VertexId(3), VertexId(4)},
       {VertexId(3), VertexId(0), VertexId(4)}});
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const Weights kind : {Weights::none, Weights::gentle})
      divide_all_cells(needles, 24, kind, seed, count);
  CHECK(count.shares > 2 * count.cells);
}

// What the localization does (fpo/remesh/localize.h): a part of a cell, among some.
TEST_CASE("cell division: a part of a cell, and a site that is excluded") {
  const TriMesh blob = fixtures::blob(6);
  const std::vector<WeightedPoint3> points =
      points_of(fixtures::placed_samples(blob, 40, 40, Weights::gentle, 8));
  const Clipper::Sites sites(points.begin(), points.end());
  SiteTree tree;
  for (std::size_t i = 0; i < points.size(); ++i) tree.insert(SiteId(i), points[i]);
  const RestrictedPower power(blob, points, tree);
  Clipper clipper(blob, sites, extent_of(blob));
  CellDivision division(clipper, power.fragments());
  std::size_t shares = 0;
  for (SiteId p(0); p.index() < points.size(); p = SiteId(p.value + 1)) {
    const std::span<const FragmentId> cell = power.fragments().of_cell(p);
    const std::vector<FragmentId> part(cell.begin(),
                                       cell.begin() + static_cast<std::ptrdiff_t>(cell.size() / 2));
    if (part.empty()) continue;
    division.begin(p, part);
    if (division.heirs().size() < 2) continue;
    const SiteId excluded = division.heirs()[0];
    division.divide();
    CHECK(shares_of(division) ==
          shares_by_definition(clipper, power.fragments(), p, part, division.heirs().sites()));
    division.begin(p, part, std::array{excluded});
    CHECK(std::ranges::count(division.heirs().sites(), excluded) == 0);
    CHECK(!division.heirs().is_stranger(excluded));
    division.divide();
    for (const CellDivision::Share& share : division.shares()) CHECK(share.polygon.owner != excluded);
    shares += division.shares().size();
  }
  CHECK(shares > 50);
}
