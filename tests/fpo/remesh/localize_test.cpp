#include "fpo/remesh/localize.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <set>

#include "doctest.h"
#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_domain.h"
#include "geom/mesh/aabb_tree.h"
#include "tests/fixtures/book.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::FragmentId;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// Tilted squares, one above the other.
TriMesh sheets(int count, double gap) {
  geom::Table<geom::VertexId, Vec3> v;
  geom::Table<FacetId, TriMesh::Facet> f;
  const Vec3 x(0.9, 0.3, 0.1), y(-0.3, 0.7, 0.4), up = x.cross(y).normalized();
  for (int i = 0; i < count; ++i) fixtures::add_grid(v, f, i == 0 ? 5 : 4, i * gap * up, x, y);
  return TriMesh(std::move(v), std::move(f));
}
std::size_t sheet_of(FacetId t) { return t.index() < 50 ? 0 : 1 + (t.index() - 50) / 32; }

double area_of_fragments(const geom::RestrictedPower& diagram) {
  double area = 0;
  for (const CellPolygon& cell : cell_polygons(diagram)) {
    Vec3 sum(0, 0, 0);
    for (std::size_t k = 2; k < cell.corners.size(); ++k)
      sum += (cell.corners[k - 1] - cell.corners[0]).cross(cell.corners[k] - cell.corners[0]);
    area += sum.norm() / 2;
  }
  return area;
}

/// A diagram to be localized, and the samples that it is of.
struct Cells {
  Cells(const TriMesh& mesh, std::vector<SurfaceSample> at)
      : samples(std::move(at)), diagram(SurfaceDomain(mesh, samples).diagram()) {}
  Cells(const TriMesh& mesh, std::size_t n, std::uint64_t seed)
      : Cells(mesh, random_samples(mesh, n, seed)) {}
  std::vector<SurfaceSample> samples;
  std::unique_ptr<geom::RestrictedPower> diagram;
};

std::size_t orphans(const Cells& cells) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.samples.size(); ++i) {
    const auto components = cell_components(*cells.diagram, geom::SiteId(i), cells.samples[i].facet);
    if (!components.empty()) count += components.size() - 1;
  }
  return count;
}

std::size_t triangles_between_sheets(const Cells& cells, const TriMesh& remesh) {
  return static_cast<std::size_t>(std::ranges::count_if(remesh.facets(), [&](const TriMesh::Facet& f) {
    std::set<std::size_t> sides;
    for (const geom::VertexId v : f) sides.insert(sheet_of(cells.samples[v.index()].facet));
    return sides.size() > 1;
  }));
}

}  // namespace

TEST_CASE("localize: the components of a cell are its fragments, connected, the sample's own first") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const Cells cells(mesh, 25, 12);
    const geom::FragmentStore& fragments = cells.diagram->fragments();
    for (std::size_t i = 0; i < 25; ++i) {
      const FacetId home = cells.samples[i].facet;
      const auto components = cell_components(*cells.diagram, geom::SiteId(i), home);
      std::set<FragmentId> seen;
      for (const auto& component : components) seen.insert(component.begin(), component.end());
      std::size_t total = 0, in_cell = 0;
      for (const auto& component : components) total += component.size();
      for (const FragmentId f : fragments.of_cell(geom::SiteId(i))) in_cell += seen.contains(f);
      CHECK(total == seen.size());
      CHECK(in_cell == seen.size());
      REQUIRE(!components.empty());
      CHECK(std::ranges::any_of(components[0], [&](FragmentId f) { return fragments.facet(f) == home; }));
    }
  }
}

TEST_CASE("localize: sheets closer than the samples come apart") {
  for (const double gap : {1e-6, 0.002, 0.05}) {
    CAPTURE(gap);
    const TriMesh mesh = sheets(2, gap);
    Cells cells(mesh, 60, 21);
    REQUIRE(orphans(cells) > 10);
    REQUIRE(triangles_between_sheets(cells, extract(*cells.diagram, 60)) > 10);
    const Localization localization = localize(*cells.diagram, cells.samples);
    CHECK(localization.orphans > 10);
    CHECK(localization.remaining == 0);
    CHECK(orphans(cells) == localization.merged);
    CHECK(area_of_fragments(*cells.diagram) == doctest::Approx(mesh.area()).epsilon(1e-9));
    const TriMesh remesh = extract(*cells.diagram, 60, localization.owners);
    CHECK(triangles_between_sheets(cells, remesh) == 0);
    for (FacetId t(0); t.index() < remesh.num_facets(); t = FacetId(t.value + 1))  // no fold
      CHECK(remesh.normal(t).dot(mesh.normal(FacetId(0))) > 0);
  }
}

TEST_CASE("localize: a plate thinner than the spacing is closed again, with all of its samples") {
  const TriMesh plate = fixtures::box(Vec3(1, 0.8, 0.002), 3);
  Cells cells(plate, 120, 5);
  REQUIRE(orphans(cells) > 20);
  const Localization localization = localize(*cells.diagram, cells.samples);
  CHECK(localization.remaining == 0);
  CHECK(orphans(cells) == localization.merged);
  CHECK(area_of_fragments(*cells.diagram) == doctest::Approx(plate.area()).epsilon(1e-9));
  const TriMesh remesh = extract(*cells.diagram, 120, localization.owners);
  const geom::Topology topology = geom::topology(remesh);
  CHECK(topology.unreferenced_vertices == 0);
  // All but a strip of half a spacing along the rim, on both sides.
  const double rim = 2 * (1 + 0.8) * hexagonal_spacing(plate.area(), 120);
  CHECK(remesh.area() > plate.area() - rim);
}

TEST_CASE("localize: where no cell has an orphan nothing happens") {
  const TriMesh blob = fixtures::blob(6);
  Cells cells(blob, 300, 2);
  REQUIRE(orphans(cells) == 0);
  const auto before = cells.diagram->canonical();
  const Localization localization = localize(*cells.diagram, cells.samples);
  CHECK(localization.orphans + localization.merged + localization.remaining == 0);
  CHECK(cells.diagram->canonical() == before);
}

TEST_CASE("localize: no more than two orphans a sample are divided, the rest is merged on its own sheet") {
  constexpr std::size_t n = 60;
  for (const int count : {3, 6}) {
    CAPTURE(count);
    const TriMesh stack = sheets(count, 1e-4);
    Cells cells(stack, n, 21);
    const std::size_t all = n * static_cast<std::size_t>(count - 1);
    REQUIRE(orphans(cells) == all);
    const Localization localization = localize(*cells.diagram, cells.samples);
    CHECK(localization.orphans >= 2 * n);
    CHECK(localization.orphans < 2 * n + static_cast<std::size_t>(count));
    CHECK((localization.merged > 0) == (all > 2 * n));
    CHECK(localization.remaining == 0);
    CHECK(orphans(cells) == localization.merged);
    CHECK(area_of_fragments(*cells.diagram) == doctest::Approx(stack.area()).epsilon(1e-9));
    CHECK(triangles_between_sheets(cells, extract(*cells.diagram, n, localization.owners)) == 0);
  }
}

TEST_CASE("localize: what has no sample is not handed on from cell to cell") {
  geom::Table<geom::VertexId, Vec3> v;
  geom::Table<FacetId, TriMesh::Facet> f;
  fixtures::add_grid(v, f, 5, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  fixtures::add_grid(v, f, 4, Vec3(0.4, 0.4, 0.003), Vec3(0.16, 0, 0), Vec3(0, 0.16, 0));
  const TriMesh mesh(std::move(v), std::move(f));
  auto samples = random_samples(mesh, 200, 21);
  std::erase_if(samples, [](const SurfaceSample& x) { return sheet_of(x.facet) == 1; });
  Cells cells(mesh, std::move(samples));
  const std::size_t before = orphans(cells);
  REQUIRE(before > 5);
  const Localization localization = localize(*cells.diagram, cells.samples);
  CHECK(localization.orphans >= before);
  CHECK(localization.orphans < cells.samples.size() / 2);
  CHECK(localization.merged == 0);
  CHECK(localization.remaining > 0);
  CHECK(orphans(cells) == localization.remaining);
  CHECK(area_of_fragments(*cells.diagram) == doctest::Approx(mesh.area()).epsilon(1e-9));
}

TEST_CASE("localize: when interrupted it divides nothing, and merges all orphans on their own sheets") {
  const TriMesh mesh = sheets(2, 0.002);
  Cells cells(mesh, 60, 21);
  const std::size_t before = orphans(cells);
  REQUIRE(before > 10);
  const auto diagram = cells.diagram->canonical();
  const std::atomic<bool> interrupted = true;
  const Localization localization = localize(*cells.diagram, cells.samples, &interrupted);
  CHECK(localization.orphans == 0);
  CHECK(localization.merged == before);
  CHECK(localization.remaining == 0);
  CHECK(cells.diagram->canonical() == diagram);
  CHECK(triangles_between_sheets(cells, extract(*cells.diagram, 60, localization.owners)) == 0);
}

TEST_CASE(
    "localize: a cell goes on across an edge of more than two facets, and only where it has that edge") {
  const TriMesh mesh = fixtures::book(5);
  std::vector<SurfaceSample> samples{{Vec3(0, 0, 0.5), FacetId(0)}};  // the middle of the spine
  for (int k = 0; k < 5; ++k)
    samples.push_back(
        {Vec3(0.9 * std::cos(0.4 * k * std::numbers::pi), 0.9 * std::sin(0.4 * k * std::numbers::pi), 0.5),
         FacetId(2 * k)});
  const Cells cells(mesh, samples);
  const auto on_spine = cell_components(*cells.diagram, geom::SiteId(0), FacetId(0));
  REQUIRE(on_spine.size() == 1);
  CHECK(on_spine[0].size() == 10);  // a part of each facet
  for (int k = 1; k <= 5; ++k)
    CHECK(
        cell_components(*cells.diagram, geom::SiteId(k), samples[static_cast<std::size_t>(k)].facet).size() ==
        1);
  // One that is nearest to pieces of two other pages, too, but to no part of the spine.
  const std::vector<SurfaceSample> two{{Vec3(0.3, 0, 0.5), FacetId(0)}, {Vec3(0, 0, 0.5), FacetId(0)}};
  const Cells both(mesh, two);
  CHECK(cell_components(*both.diagram, geom::SiteId(0), FacetId(0)).size() == 3);
  CHECK(cell_components(*both.diagram, geom::SiteId(1), FacetId(0)).size() == 1);
}
