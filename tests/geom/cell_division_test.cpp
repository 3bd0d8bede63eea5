// The two ways to divide a cell against each other, on cells of all shapes.

#include "geom/cell_division.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/initial_samples.h"
#include "geom/restricted_power.h"
#include "geom/rng.h"
#include "geom/site_tree.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;

namespace {

struct KnownShare {
  RestrictedPower::Canonical polygon;
  FragmentId joins;
  auto operator<=>(const KnownShare&) const = default;
};

std::vector<KnownShare> shares_of(CellDivision& division) {
  std::vector<KnownShare> result;
  for (const CellDivision::Share& share : division.shares()) {
    KnownShare known{{share.polygon.facet, share.polygon.owner, {}}, share.joins};
    for (const PolygonCorner& corner : share.polygon.corners) known.polygon.labels.push_back(corner.edge);
    std::rotate(known.polygon.labels.begin(), std::ranges::min_element(known.polygon.labels),
                known.polygon.labels.end());
    result.push_back(std::move(known));
  }
  std::ranges::sort(result);
  return result;
}

struct Count {
  int cells = 0, shares = 0, strangers = 0;
};

/// A diagram of n sites with weights up to `heaviest` times the area of a cell; each cell is divided among the
/// heirs that its labels name, and among all sites.
void divide_all_cells(const TriMesh& mesh, std::size_t n, double heaviest, std::uint64_t seed, Count& count) {
  SiteTree tree;
  RestrictedPower power(mesh, tree, CornerTypes::c_only);
  Clipper::Sites sites;
  Rng rng(seed);
  for (const fpo::SurfaceSample& s : fpo::random_samples(mesh, n, seed)) {
    sites.push_back({s.position, heaviest * mesh.area() / static_cast<double>(n) * rng.uniform()});
    const SiteId id(sites.size() - 1);
    tree.insert(id, sites[id]);
    power.after_insert(id, sites[id]);
  }
  const double extent = 2 * (mesh.box().min().cwiseAbs().cwiseMax(mesh.box().max().cwiseAbs()).maxCoeff());
  Clipper clipper(mesh, sites, extent);
  CellDivision division(mesh, sites, clipper, power.fragments());
  for (SiteId p(0); p.index() < n; p = SiteId(p.value + 1)) {
    const std::span<const FragmentId> fragments = power.fragments().of_cell(p);
    const std::vector<FragmentId> cell(fragments.begin(), fragments.end());
    for (const bool all : {false, true}) {
      division.begin(p, cell);
      for (SiteId j(0); j.index() < n; j = SiteId(j.value + 1))
        if (division.is_stranger(j) && (all || (division.heirs().empty() && j != p))) division.add_heir(j);
      division.divide();
      const std::vector<KnownShare> by_boundary = shares_of(division);
      for (SiteId j(0); j.index() < n && all; j = SiteId(j.value + 1))
        if (j != p) CHECK(!division.is_missing(j));
      for (SiteId j(0); j.index() < n && !all; j = SiteId(j.value + 1))
        count.strangers += division.is_stranger(j) && division.is_missing(j);
      division.divide_by_clipping();
      CHECK(by_boundary == shares_of(division));
      CHECK(!division.misfit());
      count.cells += !cell.empty();
      count.shares += static_cast<int>(by_boundary.size());
    }
  }
}

}  // namespace

TEST_CASE("cell division: by the boundary is by clipping") {
  Count count;
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    for (const double heaviest : {0.0, 0.3, 8.0})
      for (const std::size_t n : {5u, 30u, 120u}) divide_all_cells(surface.mesh, n, heaviest, n + 3, count);
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
    for (const double heaviest : {0.0, 1.0}) divide_all_cells(needles, 24, heaviest, seed, count);
  CHECK(count.shares > 2 * count.cells);
}
