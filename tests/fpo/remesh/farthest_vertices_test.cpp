// Farthest point optimization along a surface, by brute force: distances from scratch.

#include "fpo/remesh/farthest_vertices.h"

#include <algorithm>
#include <limits>
#include <set>

#include "doctest.h"
#include "fpo/remesh/surface_regions.h"
#include "fpo/surface/initial_samples.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;
using geom::VertexId;

namespace {

using Lengths = geom::Table<VertexId, double>;

/// The largest distance from all samples but x, in wanted lengths, of a vertex on no curve, and that of v.
struct Farthest {
  double most = 0, of_v = 0;
};
Farthest without(const SampledSurface& surface, SiteId x, const Lengths& wanted, VertexId v) {
  SampledSurface others = surface;
  others.vertex_of.clear();
  for (SiteId y(0); y.index() < surface.vertex_of.size(); y = SiteId(y.value + 1))
    if (y != x) others.vertex_of.push_back(surface.vertex_of[y]);
  others.curves = {};  // their vertices belong to any sample here
  const SurfaceRegions regions = surface_regions(others);
  Farthest found{0, regions.distance[v] / wanted[v]};
  for (VertexId w(0); w.index() < surface.mesh.num_vertices(); w = VertexId(w.value + 1))
    if (!surface.mesh.facets_at(w).empty() && !surface.curves.are_at(w))
      found.most = std::max(found.most, regions.distance[w] / wanted[w]);
  return found;
}

/// No sample on a curve.
SampledSurface at_vertices(const TriMesh& mesh, const Features& features,
                           const std::vector<SurfaceSample>& samples) {
  FeatureSamples none;
  none.chains.resize(features.curves.size());
  return sampled_surface({mesh, features, none, samples});
}

SampledSurface random_vertices(const TriMesh& mesh, const Features& features, std::size_t n) {
  return at_vertices(mesh, features, random_samples(mesh, n, 1));
}

}  // namespace

TEST_CASE("farthest vertices: in the end each sample is as far from the others as any vertex would be") {
  for (const char* const name : {"torus", "plate", "shell", "cube"}) {
    CAPTURE(std::string(name));
    const TriMesh mesh = geom::make_shape(name, std::string(name) == "cube" ? 6 : 12);
    SampledSurface surface = random_vertices(mesh, find_features(mesh), 40);
    Lengths wanted;
    for (VertexId v(0); v.index() < surface.mesh.num_vertices(); v = VertexId(v.value + 1))
      wanted.push_back(1 + 0.5 * surface.mesh.position(v)[0] / mesh.diagonal());
    const geom::Table<SiteId, VertexId> before = surface.vertex_of;
    const std::vector<SiteId> moved = move_to_farthest_vertices(surface, wanted, {3, 1000});
    std::set<VertexId> places;
    for (SiteId x(0); x.index() < before.size(); x = SiteId(x.value + 1)) {
      const VertexId v = surface.vertex_of[x];
      CHECK(places.insert(v).second);
      CHECK(std::ranges::binary_search(moved, x) == (v != before[x]));
      if (x.index() < 3) {
        CHECK(v == before[x]);
        continue;
      }
      CHECK(!surface.curves.are_at(v));
      const Farthest found = without(surface, x, wanted, v);
      CHECK(found.of_v == doctest::Approx(found.most).epsilon(1e-12));
    }
  }
}

TEST_CASE("farthest vertices: parts without a sample get one first") {
  const TriMesh mesh = geom::make_shape("two-spheres", 6);
  SampledSurface surface = random_vertices(mesh, {}, 12);
  VertexId next(0);  // all on the first
  for (SiteId x(0); x.index() < 12; x = SiteId(x.value + 1)) {
    const double side = mesh.position(VertexId(0))[0];
    while (mesh.position(next)[0] * side <= 0) next = VertexId(next.value + 1);
    surface.vertex_of[x] = next;
    next = VertexId(next.value + 1);
  }
  const Lengths wanted(surface.mesh.num_vertices(), 1.0);
  move_to_farthest_vertices(surface, wanted, {0, 1000});
  long balance = 0;
  for (const VertexId v : surface.vertex_of) balance += surface.mesh.position(v)[0] > 0 ? 1 : -1;
  CHECK(std::abs(balance) <= 2);
}

TEST_CASE("farthest vertices: samples of near sheets do not know of each other") {
  const TriMesh mesh = geom::make_shape("plate", 20);  // 1/40 thick
  SampledSurface surface = random_vertices(mesh, {}, 60);
  const double side = mesh.position(VertexId(0))[2];
  const auto is_there = [&](VertexId v) { return std::abs(surface.mesh.position(v)[2] - side) < 1.0 / 80; };
  VertexId next(0);
  for (VertexId& v : surface.vertex_of) {
    while (!is_there(next)) next = VertexId(next.value + 1);
    v = next;
    next = VertexId(next.value + 1);
  }
  move_to_farthest_vertices(surface, Lengths(surface.mesh.num_vertices(), 1.0), {0, 1000});
  const auto there = std::ranges::count_if(surface.vertex_of, is_there);  // all, to begin with
  CHECK(there >= 24);
  CHECK(there <= 36);
}

TEST_CASE("farthest vertices: interrupted at once nothing moves, and where all is on curves nothing can") {
  const TriMesh mesh = geom::make_shape("torus", 12);
  SampledSurface surface = random_vertices(mesh, {}, 20);
  const std::atomic<bool> stop = true;
  const Lengths wanted(surface.mesh.num_vertices(), 1.0);
  CHECK(move_to_farthest_vertices(surface, wanted, {0, 10, &stop}).empty());
  const TriMesh cube = geom::make_shape("cube", 1);
  SampledSurface corners = at_vertices(cube, find_features(cube), {});
  for (VertexId v(0); v.index() < 3; v = VertexId(v.value + 1)) corners.vertex_of.push_back(v);
  CHECK(move_to_farthest_vertices(corners, Lengths(8, 1.0), {0, 10}).empty());
}
