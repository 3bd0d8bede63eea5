// Spoilt surfaces repaired, and what is said of them before.

#include "geom/repair/repair.h"

#include "doctest.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/diagnosis.h"
#include "geom/repair/parts.h"
#include "geom/repair/repeated.h"
#include "geom/repair/t_junctions.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"
#include "tests/io/sample_meshes.h"

namespace {

using namespace fixtures;

geom::Repaired repaired(const TriMesh& mesh) { return geom::repaired(mesh, geom::all_steps()); }

}  // namespace

TEST_CASE("repair: spoilt in ten ways, closed surfaces are closed manifolds of their type again") {
  const std::pair<const char*, int> shapes[] = {{"sphere", 8}, {"torus", 24},  {"double-torus", 24},
                                                {"blob", 8},   {"l-block", 5}, {"two-spheres", 6}};
  for (const auto& shape : shapes) {
    const TriMesh mesh = geom::make_shape(shape.first, shape.second);
    const geom::Topology before = geom::topology(mesh);
    REQUIRE(before.boundary_edges == 0);
    for (std::size_t way = 0; way < fixtures::ways_to_spoil.size(); ++way)
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        CAPTURE(shape.first);
        CAPTURE(fixtures::ways_to_spoil[way]);
        CAPTURE(seed);
        const TriMesh bad = fixtures::spoilt(mesh, way, seed);
        const geom::Repaired result = repaired(bad);
        const geom::Topology after = geom::topology(result.mesh);
        CHECK(after.manifold());
        CHECK(after.boundary_edges == 0);
        CHECK(after.misoriented_edges == 0);
        CHECK(after.euler == before.euler);
        CHECK(after.components == before.components);
        if (way < 9) CHECK(result.mesh.area() == doctest::Approx(mesh.area()).epsilon(0.02));
        if (way < 9) CHECK(!result.lines.empty());
        CHECK(fixtures::identical(repaired(bad).mesh, result.mesh));
        CHECK(repaired(result.mesh).lines.empty());
        CHECK(geom::in_words(geom::diagnosis(result.mesh, false)) == "");
        if (way < 9 && way != 4)  // what cleaning alone mends needs no other option
          CHECK(geom::in_words(geom::diagnosis(bad, false)) != "");
      }
  }
}

TEST_CASE("repair: sound meshes come back as they are, open ones stay open") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    if (surface.name.find("two-sided") != std::string::npos) continue;
    CHECK(fixtures::identical(geom::repaired(mesh, {}).mesh, mesh));
  }
  const TriMesh square = fixtures::tilted_square(8);
  CHECK(fixtures::identical(repaired(square).mesh, square));
}

TEST_CASE("repair: any size and place") {
  Rng rng(7);
  const TriMesh mesh = geom::make_shape("torus");
  for (const double factor : {0x1p-700, 0x1p-100, 0x1p100, 0x1p700}) {
    const geom::Repaired result = repaired(geom::scaled(fixtures::spoilt(mesh, 2), factor));
    CHECK(
        fixtures::identical(geom::scaled(result.mesh, 1 / factor), repaired(fixtures::spoilt(mesh, 2)).mesh));
  }
}

TEST_CASE("repair: steps alone do their own work only") {
  const TriMesh mesh = geom::make_shape("torus");
  geom::RepairSteps orient;
  orient.orient = true;
  const geom::Topology holes = geom::topology(geom::repaired(fixtures::spoilt(mesh, 2), orient).mesh);
  CHECK(holes.boundary_edges > 0);
  geom::RepairSteps fill;
  fill.holes = 1e30;
  CHECK(geom::topology(geom::repaired(fixtures::spoilt(mesh, 2), fill).mesh).boundary_edges == 0);
  geom::RepairSteps crumbs;
  crumbs.crumbs = 0.4;
  const TriMesh pair =
      geom::joined(mesh, geom::mapped(mesh, [](const Vec3& p) { return Vec3(0.5 * p + Vec3(10, 0, 0)); }));
  CHECK(fixtures::identical(geom::repaired(pair, crumbs).mesh, mesh));
}

TEST_CASE("repair: wide gaps are welded within the tolerance asked for, and no facet collapses") {
  Rng rng(2);
  const TriMesh mesh = geom::make_shape("sphere");
  const TriMesh torn = fixtures::split_vertices(mesh, 1e-3, rng);
  geom::RepairSteps steps;
  steps.weld = 4e-3 * mesh.diagonal();
  steps.split = true;
  const geom::Topology t = geom::topology(geom::repaired(torn, steps).mesh);
  CHECK(t.euler == 2);
  CHECK(t.boundary_edges == 0);
  CHECK(t.facets == mesh.num_facets());
}

TEST_CASE("repair: bodies welded at a common face become one, doubled facets do not open the surface") {
  const TriMesh a = fixtures::box(Vec3(1, 1, 1), 3);
  const auto moved = [&](const Vec3& by) {
    return geom::mapped(a, [&](const Vec3& p) { return Vec3(p + by); });
  };
  const TriMesh row = geom::joined(geom::joined(a, moved({1, 0, 0})), moved({2, 0, 0}));
  const geom::Repaired result = repaired(fixtures::weld(row.vertices(), row.facets()));
  const geom::Topology t = geom::topology(result.mesh);
  CHECK(t.manifold());
  CHECK(t.components == 1);
  CHECK(t.euler == 2);
  CHECK(t.boundary_edges == 0);
  CHECK(result.mesh.area() == doctest::Approx(14));
  CHECK(result.lines == std::vector<std::string>{"dropped 72 facets between bodies welded together"});

  // A corner only, all of it and nothing of it: no wall.
  const TriMesh corner = geom::joined(a, moved({1, 1, 1}));
  geom::Table<geom::FacetId, TriMesh::Facet> facets =
      fixtures::weld(corner.vertices(), corner.facets()).facets();
  CHECK(geom::drop_walls(facets) == 0);
  facets = a.facets();
  for (const TriMesh::Facet& f : a.facets()) facets.push_back({f[1], f[0], f[2]});
  CHECK(geom::drop_walls(facets) == 0);
  facets = a.facets();
  for (std::size_t i = 0; i < 5; ++i) {  // some of them neighbours
    const TriMesh::Facet f = facets[FacetId(i)];
    facets.push_back({f[1], f[0], f[2]});
  }
  CHECK(geom::drop_walls(facets) == 0);
}

TEST_CASE("diagnosis: a tolerance is named where borders nearly meet, and welds them") {
  const TriMesh tube = geom::make_shape("tube", 24);  // two borders, a hundredth of the edges
  CHECK(geom::diagnosis(tube, false).weld_tolerance == 0);
  for (const double gap : {3e-4, 4e-3, 0.012}) {
    CAPTURE(gap);
    const TriMesh tubes =
        geom::joined(tube, geom::mapped(tube, [&](const Vec3& p) { return Vec3(p + Vec3(0, 0, gap)); }));
    const double tolerance = geom::diagnosis(tubes, false).weld_tolerance;
    CHECK(tolerance >= gap);
    CHECK(tolerance <= 5 * gap);
    geom::RepairSteps weld;
    weld.weld = tolerance;
    const geom::Topology t = geom::topology(geom::repaired(tubes, weld).mesh);
    CHECK(t.euler == 0);
    CHECK(t.boundary_edges == 0);
  }
}

TEST_CASE("t-junctions: several on one edge, on all edges of a facet, and none where nothing is near") {
  // A triangle whose sides have two neighbours' vertices each.
  MeshArrays mesh;
  const std::array<Vec3, 3> q = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0)};
  for (const Vec3& p : q) mesh.add(p);
  mesh.add_triangle(VertexId(0), VertexId(1), VertexId(2));
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3 &a = q[e], &b = q[(e + 1) % 3], out = (a + b) / 2 - q[(e + 2) % 3] + Vec3(0, 0, 1);
    const VertexId tip = mesh.add((a + b) / 2 + out);
    std::array<VertexId, 4> chain = {VertexId(e), mesh.add(a + (b - a) / 3), mesh.add(b + (a - b) / 3),
                                     VertexId((e + 1) % 3)};
    for (std::size_t i = 0; i < 3; ++i) mesh.add_triangle(chain[i + 1], chain[i], tip);
  }
  CHECK(geom::zip_t_junctions(mesh.vertices, mesh.facets, 1e-9) == 6);
  const TriMesh zipped = mesh.take();
  const geom::Topology t = geom::topology(zipped);
  CHECK(t.manifold());
  CHECK(t.boundary_edges == 6);
  CHECK(t.euler == 1);
  CHECK(t.misoriented_edges == 0);
  for (const auto& [name, sound] : fixtures::surfaces()) {
    MeshArrays arrays = fixtures::arrays_of(sound);
    CHECK(geom::zip_t_junctions(arrays.vertices, arrays.facets, 1e-9) == 0);
  }
}

TEST_CASE("diagnosis: sound shapes have no faults") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const geom::Diagnosis d = geom::diagnosis(mesh, true);
    CHECK(d.split_vertices + d.duplicate_facets + d.degenerate_facets == 0);
    CHECK(d.border_lengths.size() == geom::topology(mesh).boundary_loops);
    CHECK(d.intersections->all);
  }
  CHECK(geom::diagnosis(geom::make_shape("torus"), true).intersections->pairs == 0);
  CHECK(geom::in_words(geom::diagnosis(geom::make_shape("torus"), false)) == "");
}

TEST_CASE("diagnosis: each fault is counted") {
  const TriMesh mesh = geom::make_shape("torus");
  Rng rng(9);
  CHECK(geom::diagnosis(fixtures::split_vertices(mesh, 0, rng), false).split_vertices > 0);
  CHECK(geom::diagnosis(fixtures::split_vertices(mesh, 0, rng), false).stray_facets == mesh.num_facets());
  CHECK(geom::diagnosis(fixtures::with_holes(mesh, 0.01, rng), false).holes > 0);
  CHECK(geom::diagnosis(fixtures::with_flips(mesh, 0.1, rng), false).inverted_facets > 0);
  CHECK(geom::diagnosis(fixtures::with_flips(mesh, 1, rng), false).inside_out_parts == 1);
  CHECK(geom::diagnosis(fixtures::with_duplicates(mesh, 0.01, rng), false).duplicate_facets > 0);
  CHECK(geom::diagnosis(geom::joined(mesh, mesh), false).duplicate_facets == mesh.num_facets());
  const geom::Diagnosis fins = geom::diagnosis(fixtures::with_fins(mesh, 3, rng), false);
  CHECK(fins.topology.nonmanifold_edges == 3);
  CHECK(geom::in_words(fins).find("3 non-manifold edges") == 0);
}

TEST_CASE("diagnosis: self-intersections are those found by trying all pairs") {
  const TriMesh ball = geom::make_shape("sphere", 4);
  const TriMesh pair = geom::joined(
      ball, geom::mapped(ball, [&](const Vec3& p) { return Vec3(p + 0.3 * Vec3(1, 0.9, 0.8)); }));
  const geom::Intersections found =
      geom::self_intersections(geom::scaled(pair, geom::factor_to_unit_box(pair)));
  CHECK(found.pairs > 10);
  CHECK(found.all);
  CHECK(found.first.valid());
}

TEST_CASE("repair: crumbs are dropped unless they are most of what there is") {
  Rng rng(3);
  const TriMesh soup = fixtures::split_vertices(geom::make_shape("sphere"), 0, rng);
  MeshArrays arrays = fixtures::arrays_of(soup);
  CHECK(geom::drop_crumbs(arrays.vertices, arrays.facets, {}) == 0);
}

TEST_CASE("repair: corners that differ by a ten-thousandth of the size are welded, whatever the seed") {
  const TriMesh mesh = geom::make_shape("torus", 24);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    const geom::Topology t = geom::topology(repaired(fixtures::split_vertices(mesh, 1e-4, rng)).mesh);
    CHECK(t.manifold());
    CHECK(t.boundary_edges == 0);
    CHECK(t.euler == 0);
    CHECK(t.components == 1);
  }
}

TEST_CASE("repair: slits in one piece are no soup, however much of it is border") {
  geom::Table<VertexId, Vec3> vertices;  // a comb: strips .01 apart that hang together at one end
  geom::Table<FacetId, TriMesh::Facet> facets;
  constexpr int strips = 20, rows = 6, side = rows + 1;  // slits of more sides than a dent has
  for (int i = 0; i < strips; ++i)
    for (const double x : {0.0, 0.99})
      for (int k = 0; k <= rows; ++k) vertices.push_back(Vec3(i + x, k, 0));
  const auto quad = [&](int a, int b, int c, int d) {
    facets.push_back({VertexId(a), VertexId(b), VertexId(c)});
    facets.push_back({VertexId(a), VertexId(c), VertexId(d)});
  };
  for (int i = 0; i < strips; ++i)
    for (int k = 0, a = 2 * side * i; k < rows; ++k, ++a) quad(a, a + side, a + side + 1, a + 1);
  for (int i = 0, a = side; i + 1 < strips; ++i, a += 2 * side) quad(a, a + side, a + side + 1, a + 1);
  const TriMesh comb(std::move(vertices), std::move(facets));
  const geom::Topology before = geom::topology(comb);
  REQUIRE(before.components == 1);
  REQUIRE(10 * before.boundary_edges > before.edges);
  const geom::Topology after = geom::topology(repaired(comb).mesh);
  CHECK(after.boundary_edges == before.boundary_edges);
  CHECK(after.euler == before.euler);
}
