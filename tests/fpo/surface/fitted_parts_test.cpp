#include "fpo/surface/fitted_parts.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/mesh_parts.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

using Function = double (*)(const Vec3&);

Table<VertexId, double> values_at(const TriMesh& mesh, Function f) {
  Table<VertexId, double> values;
  for (const Vec3& p : mesh.vertices()) values.push_back(f(p));
  return values;
}

std::array<Vec3, 3> corners(const TriMesh& mesh, FacetId t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

FacetId nearest_part(const SplitSurface& parts, FacetId parent, const Vec3& x) {
  FacetId best;
  double least = 1e300;
  const auto range = std::equal_range(parts.parents.begin(), parts.parents.end(), parent);
  for (auto i = range.first; i < range.second; ++i) {
    const FacetId t(static_cast<std::size_t>(i - parts.parents.begin()));
    const double distance2 = geom::closest_point(x, corners(parts.mesh, t)).distance2;
    if (distance2 < least) least = distance2, best = t;
  }
  return best;
}

/// On the part nearest to x of those of one parent.
double value_at(const FittedParts& fitted, FacetId parent, const Vec3& x) {
  const FacetId t = nearest_part(fitted.surface, parent, x);
  const auto [a, b, c] = corners(fitted.surface.mesh, t);
  const Vec3 n = (b - a).cross(c - a);
  const double v = (x - a).cross(c - a).dot(n) / n.squaredNorm(),
               w = (b - a).cross(x - a).dot(n) / n.squaredNorm();
  const TriMesh::Facet& f = fitted.surface.mesh.facet(t);
  return (1 - v - w) * fitted.values[f[0]] + v * fitted.values[f[1]] + w * fitted.values[f[2]];
}

bool is_short(const TriMesh& mesh, FacetId t, double most) {
  const auto [a, b, c] = corners(mesh, t);
  return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}) <= most;
}

void check_same_surface(const TriMesh& mesh, const SplitSurface& parts) {
  CHECK(parts.mesh.area() == doctest::Approx(mesh.area()));
  const geom::Topology was = geom::topology(mesh), is = geom::topology(parts.mesh);
  CHECK(is.euler == was.euler);
  CHECK(is.boundary_loops == was.boundary_loops);
  CHECK(is.nonmanifold_edges == was.nonmanifold_edges);
  CHECK(is.misoriented_edges == was.misoriented_edges);
  std::vector<double> areas(mesh.num_facets(), 0);
  for (FacetId t(0); t.index() < parts.mesh.num_facets(); t = FacetId(t.value + 1)) {
    areas[parts.parents[t].index()] += parts.mesh.area(t);
    CHECK(parts.mesh.normal(t).dot(mesh.normal(parts.parents[t])) > 0);
  }
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    CHECK(areas[t.index()] == doctest::Approx(mesh.area(t)));
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    CHECK(parts.mesh.position(v) == mesh.position(v));
}

double ridge(const Vec3& p) { return std::abs(p.x() + 0.5 * p.y() - 0.1 * p.z()); }
double wave(const Vec3& p) { return 0.3 * std::sin(9 * p.x()) * std::cos(7 * p.y()); }
double plane(const Vec3& p) { return 0.4 * p.x() - 0.2 * p.y() + p.z(); }
double constant(const Vec3&) { return 0.75; }

}  // namespace

TEST_CASE("fitted parts: the same surface, and the function within its tolerance or edges short") {
  std::size_t fewer = 0;
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const double h = 0.05 * mesh.diagonal();
    const FitOptions options{0.5, 1e9, 0.1};
    for (const bool adaptive : {false, true}) {
      VertexField lengths;
      for (const Vec3& p : mesh.vertices())
        lengths.push_back(h * (1 + (p - mesh.box().min()).norm() / mesh.diagonal()));
      const Sizing sizing = adaptive ? Sizing(mesh, lengths) : Sizing::uniform(h);
      const SplitSurface fine = split_long_edges(mesh, sizing, options.longest, {});
      const Sizing there = adaptive ? Sizing(fine.mesh, fine.h) : sizing;
      for (const Function f : {ridge, wave, plane, constant}) {
        const Table<VertexId, double> values = values_at(fine.mesh, f);
        const auto found = fitted_parts(mesh, sizing, {fine, values}, options, {});
        if (!found) {
          CHECK((f == ridge || f == wave));
          continue;
        }
        const FittedParts& fitted = *found;
        ++fewer;
        check_same_surface(mesh, fitted.surface);
        CHECK(fitted.surface.h.empty() == !adaptive);
        REQUIRE(fitted.values.size() == fitted.surface.mesh.num_vertices());
        if (f == constant || f == plane) CHECK(fitted.surface.mesh.num_facets() == mesh.num_facets());
        std::size_t off = 0;
        for (FacetId t(0); t.index() < fine.mesh.num_facets(); t = FacetId(t.value + 1))
          for (std::size_t i = 0; i < 3; ++i) {
            const VertexId v = fine.mesh.facet(t)[i];
            const Vec3& x = fine.mesh.position(v);
            const double error = std::abs(value_at(fitted, fine.parents[t], x) - values[v]);
            const FacetId part = nearest_part(fitted.surface, fine.parents[t], x);
            const double most = options.longest * 2 * h;
            off += error > options.tolerance * there.at(v) * (1 + 1e-9) + 1e-9 &&
                   !is_short(fitted.surface.mesh, part, most);
          }
        CHECK(off == 0);
      }
    }
  }
  CHECK(fewer > 40);
}

TEST_CASE("fitted parts: far fewer of a large facet whose function bends at one line only") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  const Sizing sizing = Sizing::uniform(0.05);
  const SplitSurface fine = split_long_edges(mesh, sizing, 0.6, {});
  const auto fitted = fitted_parts(mesh, sizing, {fine, values_at(fine.mesh, ridge)}, {0.6, 1e9, 0.1}, {});
  REQUIRE(fitted);
  CHECK(fitted->surface.mesh.num_facets() > mesh.num_facets());
  CHECK(4 * fitted->surface.mesh.num_facets() < fine.mesh.num_facets());
}

TEST_CASE("fitted parts: no edge longer than the largest, wherever the function is linear") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  const Sizing sizing = Sizing::uniform(0.05);
  const SplitSurface fine = split_long_edges(mesh, sizing, 0.6, {});
  for (const double largest : {1.0, 4.0}) {
    const auto fitted =
        fitted_parts(mesh, sizing, {fine, values_at(fine.mesh, plane)}, {0.6, largest, 0.1}, {});
    REQUIRE(fitted);
    check_same_surface(mesh, fitted->surface);
    CHECK_FALSE(has_long_edges(fitted->surface.mesh, sizing, largest));
    CHECK(has_long_edges(fitted->surface.mesh, sizing, largest / 4));
  }
}

TEST_CASE("fitted parts: samples come to the part of their facet that has them") {
  std::size_t found = 0;
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const Sizing sizing = Sizing::uniform(0.05 * mesh.diagonal());
    const std::vector<SurfaceSample> before = random_samples(mesh, sizing, 200, 3);
    std::vector<SurfaceSample> samples = before;
    const SplitSurface fine = split_long_edges(mesh, sizing, 0.5, {});
    const auto fitted =
        fitted_parts(mesh, sizing, {fine, values_at(fine.mesh, wave)}, {0.5, 1e9, 0.02}, samples);
    if (!fitted) {
      for (std::size_t i = 0; i < samples.size(); ++i) CHECK(samples[i].facet == before[i].facet);
      continue;
    }
    ++found;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      CHECK(fitted->surface.parents[samples[i].facet] == before[i].facet);
      const auto part = corners(fitted->surface.mesh, samples[i].facet);
      CHECK(std::sqrt(geom::closest_point(samples[i].position, part).distance2) < 1e-12 * mesh.diagonal());
    }
  }
  CHECK(found > 3);
}

TEST_CASE("fitted parts: needles, and facets that share their sides") {
  for (const int needles : {3, 40, 200}) {
    geom::MeshArrays fan;
    const VertexId tip = fan.add({0, 0, 1});
    for (int i = 0; i <= needles; ++i) fan.add({30.0, 0.01 * i, 0});
    for (int i = 0; i < needles; ++i)
      fan.add_triangle(tip, VertexId(std::size_t(i) + 1), VertexId(std::size_t(i) + 2));
    const TriMesh mesh = fan.take();
    const Sizing sizing = Sizing::uniform(1);
    const SplitSurface fine = split_long_edges(mesh, sizing, 0.6, {});
    for (const Function f : {ridge, wave, constant}) {
      const auto fitted = fitted_parts(mesh, sizing, {fine, values_at(fine.mesh, f)}, {0.6, 1e9, 0.1}, {});
      if (fitted) check_same_surface(mesh, fitted->surface);
      if (fitted)
        CHECK(fitted->surface.mesh.num_facets() < std::max(fine.mesh.num_facets(), mesh.num_facets() + 1));
      CHECK((fitted || f != constant));
    }
  }
}
