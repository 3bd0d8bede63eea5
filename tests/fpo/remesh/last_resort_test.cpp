// Remeshes whose diagrams are of another type than the input: joined otherwise, and told right.

#include "fpo/remesh/last_resort.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::TriMesh;
using geom::VertexId;

namespace {

RemeshResult few_samples(const char* name, std::size_t n, bool keep_cells = false,
                         Sheets sheets = Sheets::automatic) {
  RemeshOptions options = default_options(n, SizingKind::uniform);
  options.features = automatic_features();
  options.features->yielding = true;
  options.keep_cells = keep_cells;
  options.sheets = sheets;
  return remesh(geom::make_shape(name), options);
}

/// A profile (radius, height) turned about an axis.
TriMesh turned(const std::vector<std::array<double, 2>>& profile, std::size_t around) {
  const std::size_t across = profile.size();
  const auto vertex = [&](std::size_t i, std::size_t j) {
    return VertexId(i % around * across + j % across);
  };
  geom::Table<VertexId, geom::Vec3> positions;
  geom::Table<geom::FacetId, TriMesh::Facet> facets;
  for (std::size_t i = 0; i < around; ++i)
    for (std::size_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(around);
      positions.push_back({profile[j][0] * std::cos(u), profile[j][0] * std::sin(u), profile[j][1]});
      facets.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      facets.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return TriMesh(std::move(positions), std::move(facets));
}

/// A torus of radii 1 and .06.
TriMesh thin_ring() {
  std::vector<std::array<double, 2>> circle;
  for (int j = 0; j < 16; ++j)
    circle.push_back(
        {1 + 0.06 * std::cos(std::numbers::pi * j / 8), 0.06 * std::sin(std::numbers::pi * j / 8)});
  return turned(circle, 240);
}

RemeshResult with_automatic_creases(const TriMesh& surface, std::size_t n) {
  RemeshOptions options = default_options(n, SizingKind::uniform);
  options.features = automatic_features();
  options.features->yielding = true;
  return remesh(surface, options);
}

}  // namespace

TEST_CASE("last resort: too few samples for the diagram make a surface of the right type") {
  for (const auto& [name, n] : {std::pair("dumbbell", 50), {"thin-handle", 50}, {"narrow-torus", 50}}) {
    CAPTURE(std::string(name));
    const auto size = static_cast<std::size_t>(n);
    const RemeshResult result = few_samples(name, size, true);
    CHECK(result.by_collapses);
    CHECK(result.type.ok());
    CHECK(result.advice.places.empty());
    CHECK(result.mesh.num_vertices() == size);
    CHECK(result.wanted.size() == size);
    CHECK(result.sizing.size() == geom::make_shape(name).num_vertices());
    CHECK(result.measures.theta_min > 0);
    double area = 0;
    for (const CellPolygon& cell : result.cells)
      for (std::size_t k = 1; k + 1 < cell.corners.size(); ++k)
        area += (cell.corners[k] - cell.corners[0]).cross(cell.corners[k + 1] - cell.corners[0]).norm() / 2;
    CHECK(area == doctest::Approx(geom::make_shape(name).area()).epsilon(1e-6));
    const TriMesh surface = geom::make_shape(name);
    for (std::size_t i = 0; i < size; ++i) {
      const SurfaceSample& x = result.samples[i];
      CHECK((result.mesh.position(VertexId(i)) - x.position).norm() < 1e-9);
      CHECK(geom::closest_point(x.position, {surface.corner(x.facet, 0), surface.corner(x.facet, 1),
                                             surface.corner(x.facet, 2)})
                .distance2 < 1e-12);
    }
  }
}

TEST_CASE("last resort: a tube that is thin all along has its samples spread along it") {
  constexpr std::size_t n = 150;
  RemeshOptions options = default_options(n, SizingKind::uniform);
  const RemeshResult result = remesh(thin_ring(), options);
  CHECK(result.type.ok());
  CHECK(result.measures.angles_below_30 < n / 10);
}

TEST_CASE("last resort: a flat ring has few samples where those on its creases make no triangle") {
  const TriMesh gasket = turned({{1, 0}, {1, 0.02}, {0.8, 0.02}, {0.8, 0}}, 90);
  for (const std::size_t n : {12u, 20u, 24u}) {
    CAPTURE(n);
    const RemeshResult result = with_automatic_creases(gasket, n);
    CHECK(result.type.ok());
    CHECK(result.mesh.num_vertices() == n);
    CHECK(result.features_missed);
    CHECK(!result.given_up.empty());
  }
}

TEST_CASE("last resort: a comb too thin for its creases and samples is of its type without them") {
  const RemeshResult result = with_automatic_creases(geom::make_shape("comb"), 90);
  CHECK(result.type.ok());
  CHECK(result.crease_curves == 0);
  CHECK(result.given_up.starts_with("creases dropped"));
}

TEST_CASE("last resort: where the diagram is right there is none") {
  const RemeshResult result = few_samples("torus", 200);
  CHECK(!result.by_collapses);
  CHECK(!result.last_resort);
}

TEST_CASE("last resort: nobody mends, no other mesh") {
  RemeshOptions options = default_options(50, SizingKind::uniform);
  options.mend = false;
  const RemeshResult result = remesh(geom::make_shape("narrow-torus"), options);
  CHECK(!result.type.ok());
  CHECK(!result.by_collapses);
}
