#include "fpo/surface/needle_parts.h"

#include <cmath>
#include <random>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/split_facets.h"
#include "geom/shapes/mesh_parts.h"

using namespace fpo;
using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

TriMesh one_facet(const Vec3& a, const Vec3& b, const Vec3& c) {
  geom::MeshArrays arrays;
  for (const Vec3& p : {a, b, c}) arrays.add(p);
  arrays.add_triangle(VertexId(0), VertexId(1), VertexId(2));
  return arrays.take();
}

/// A disk of a fan of needles, and its other side: a closed surface of needles only.
TriMesh coin(int needles, double thickness) {
  geom::MeshArrays arrays;
  const double pi = std::acos(-1);
  for (const double z : {0.0, thickness})
    for (int i = 0; i < needles; ++i)
      arrays.add({std::cos(2 * pi * i / needles), std::sin(2 * pi * i / needles), z});
  const auto at = [&](int side, int i) { return VertexId(static_cast<std::size_t>(side * needles + i)); };
  for (int i = 1; i + 1 < needles; ++i) {
    arrays.add_triangle(at(0, 0), at(0, i + 1), at(0, i));
    arrays.add_triangle(at(1, 0), at(1, i), at(1, i + 1));
  }
  for (int i = 0; i < needles; ++i) {
    const int j = (i + 1) % needles;
    arrays.add_triangle(at(0, i), at(0, j), at(1, j));
    arrays.add_triangle(at(0, i), at(1, j), at(1, i));
  }
  return arrays.take();
}

}  // namespace

TEST_CASE("needle parts: cover the facet once, with short edges, and are few") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t needles = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double length = std::exp2(3 + 6 * unit(random)), width = length * std::exp2(-2 - 8 * unit(random));
    const Vec3 a(0, 0, 0), b(length, 0.3 * length, 0), c(unit(random) * length, width, 0.2 * width);
    const TriMesh mesh = one_facet(a, b, c);
    const Sizing sizing = Sizing::uniform(1);
    HalvedEdges edges(mesh, sizing, 1);
    const TriMesh::Facet facet{VertexId(0), VertexId(1), VertexId(2)};
    if (!NeedleParts::is_needle(facet, edges)) continue;
    ++needles;
    Table<FacetId, TriMesh::Facet> parts;
    NeedleParts(edges).cut(facet, 1000000, parts);
    const double longest =
        std::sqrt(std::max({edges.length2(VertexId(0), VertexId(1)), edges.length2(VertexId(1), VertexId(2)),
                            edges.length2(VertexId(2), VertexId(0))}));
    const double area = mesh.area(FacetId(0));
    CHECK(static_cast<double>(parts.size()) < 16 + 4 * longest + 6 * area);
    const TriMesh cut(edges.take_positions(), std::move(parts));
    CHECK_FALSE(has_long_edges(cut, sizing, 1));
    CHECK(cut.area() == doctest::Approx(area));
    std::size_t turned = 0;
    for (FacetId t(0); t.index() < cut.num_facets(); t = FacetId(t.value + 1))
      turned += !(cut.normal(t).dot(mesh.normal(FacetId(0))) > 0);
    CHECK(turned == 0);
    const geom::Topology type = geom::topology(cut);
    CHECK(type.manifold());
    CHECK(type.euler == 1);
    CHECK(type.boundary_loops == 1);
  }
  CHECK(needles > 100);
}

TEST_CASE("needle parts: those beside each other and beside other facets fit, samples stay in their facet") {
  for (const int needles : {3, 7, 40, 200})
    for (const double thickness : {0.01, 0.3}) {
      CAPTURE(needles);
      CAPTURE(thickness);
      const TriMesh mesh = coin(needles, thickness);
      VertexField lengths;
      for (const Vec3& p : mesh.vertices()) lengths.push_back(0.02 + 0.02 * (p.x() + 1));
      const Sizing sizing(mesh, lengths);
      const std::vector<SurfaceSample> before = random_samples(mesh, sizing, 100, 3);
      std::vector<SurfaceSample> samples = before;
      const SplitSurface split = split_long_edges(mesh, sizing, 1, samples);
      CHECK_FALSE(has_long_edges(split.mesh, Sizing(split.mesh, split.h), 1));
      CHECK(split.mesh.area() == doctest::Approx(mesh.area()));
      const geom::Topology type = geom::topology(split.mesh);
      CHECK(type.manifold());
      CHECK(type.euler == 2);
      CHECK(type.misoriented_edges == 0);
      std::size_t turned = 0;
      for (FacetId t(0); t.index() < split.mesh.num_facets(); t = FacetId(t.value + 1))
        turned += !(split.mesh.normal(t).dot(mesh.normal(split.parents[t])) > 0);
      CHECK(turned == 0);
      for (std::size_t i = 0; i < samples.size(); ++i)
        CHECK(split.parents[samples[i].facet] == before[i].facet);
    }
}

TEST_CASE("needle parts: no more than wanted, and what is cut is cut whole") {
  const TriMesh mesh = one_facet({0, 0, 0}, {1e9, 0, 0}, {0, 1, 0});
  HalvedEdges edges(mesh, Sizing::uniform(1), 1);
  Table<FacetId, TriMesh::Facet> parts;
  NeedleParts(edges).cut({VertexId(0), VertexId(1), VertexId(2)}, 500, parts);
  CHECK(parts.size() > 500);
  CHECK(parts.size() <= 503);
  CHECK(TriMesh(edges.take_positions(), std::move(parts)).area() == doctest::Approx(mesh.area()));
}
