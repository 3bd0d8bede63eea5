// A surface with the samples among its vertices against the surface: area, type, curves, places. Regions
// against paths found by brute force.

#include "fpo/remesh/sampled_surface.h"

#include <algorithm>
#include <limits>

#include "doctest.h"
#include "fpo/remesh/surface_regions.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/sizing.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/surface_type.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

struct SampledScene {
  TriMesh surface;
  Features features;
  FeatureSamples of_features;
  std::vector<SurfaceSample> samples;
};

/// Features first, then anywhere, one of them at a vertex, one in the middle of an edge.
SampledScene scene(const char* name, int size, std::size_t n) {
  SampledScene s{geom::make_shape(name, size), {}, {}, {}};
  s.features = find_features(s.surface);
  CurveSampling sampling;
  sampling.most = n;
  s.of_features = sample_features(s.surface, s.features, {},
                                  Sizing::uniform(hexagonal_spacing(s.surface.area(), n)), sampling);
  s.samples = s.of_features.samples;
  const std::vector<SurfaceSample> others = random_samples(s.surface, n - s.samples.size(), 1);
  s.samples.insert(s.samples.end(), others.begin(), others.end());
  return s;
}

SampledSurface sampled(const SampledScene& s) {
  return sampled_surface({s.surface, s.features, s.of_features, s.samples});
}

void require_right(const SampledScene& s, const SampledSurface& found) {
  const TriMesh mesh = found.mesh.mesh();
  CHECK(geom::surface_type(mesh).parts == geom::surface_type(s.surface).parts);
  CHECK(mesh.area() == doctest::Approx(s.surface.area()).epsilon(1e-6));
  CHECK(found.parents.size() == found.mesh.num_facets());
  for (FacetId t(0); t.index() < found.mesh.num_facets(); t = FacetId(t.value + 1)) {
    const FacetId parent = found.parents[t];
    for (const VertexId v : found.mesh.facet(t)) {
      const double off = geom::closest_point(found.mesh.position(v),
                                             {s.surface.corner(parent, 0), s.surface.corner(parent, 1),
                                              s.surface.corner(parent, 2)})
                             .distance2;
      CHECK(off < 1e-12 * s.surface.diagonal() * s.surface.diagonal());
    }
  }
  std::vector<VertexId> taken;
  for (SiteId x(0); x.index() < s.samples.size(); x = SiteId(x.value + 1)) {
    taken.push_back(found.vertex_of[x]);
    CHECK((found.mesh.position(taken.back()) - s.samples[x.index()].position).norm() <
          1e-6 * s.surface.diagonal());
  }
  std::ranges::sort(taken);
  CHECK(std::ranges::adjacent_find(taken) == taken.end());
}

/// From each sample of a chain along edges of curves to the next one, and no other sample in between.
void require_curves(const SampledScene& s, const SampledSurface& found) {
  std::vector<char> is_sample(found.mesh.num_vertices(), 0);
  for (const VertexId v : found.vertex_of) is_sample[v.index()] = 1;
  std::size_t chains = 0;
  for (const std::vector<SiteId>& chain : s.of_features.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i, ++chains) {
      const VertexId from = found.vertex_of[chain[i]], to = found.vertex_of[chain[i + 1]];
      const bool is_joined = std::ranges::any_of(found.curves.beside(from), [&](VertexId next) {
        VertexId before = from;
        while (!is_sample[next.index()]) {
          const std::vector<VertexId>& ends = found.curves.beside(next);
          REQUIRE(ends.size() == 2);
          before = std::exchange(next, ends[ends[0] == before ? 1 : 0]);
        }
        return next == to;
      });
      CHECK(is_joined);
    }
  CHECK(chains == num_edges(s.of_features));
}

}  // namespace

TEST_CASE(
    "sampled surface: all samples are vertices, on the curves that they are on, and nothing else changes") {
  for (const auto& [name, size, n] :
       {std::tuple("cube", 1, 300), {"sphere", 12, 100}, {"gear", 0, 400}, {"moebius", 0, 60}}) {
    CAPTURE(std::string(name));
    const SampledScene s = scene(name, size, static_cast<std::size_t>(n));
    const SampledSurface found = sampled(s);
    require_right(s, found);
    require_curves(s, found);
  }
}

TEST_CASE("sampled surface: samples at a vertex, on an edge, twice in one place") {
  SampledScene s = scene("sphere", 12, 20);
  const FacetId t(7);
  s.samples.push_back({s.surface.corner(t, 1), t});
  s.samples.push_back({(s.surface.corner(t, 0) + s.surface.corner(t, 2)) / 2, t});
  s.samples.push_back(s.samples.back());
  const SampledSurface found = sampled(s);
  require_right(s, found);
  CHECK(found.vertex_of[SiteId(std::size_t(20))] == s.surface.facet(t)[1]);
  CHECK(found.mesh.num_vertices() == s.surface.num_vertices() + s.samples.size() - 1);
}

TEST_CASE("surface regions: no way to a sample is shorter than that to the one of the region") {
  const SampledScene s = scene("sphere", 8, 15);
  const SampledSurface surface = sampled(s);
  const SurfaceRegions regions = surface_regions(surface);
  const std::size_t n = surface.mesh.num_vertices();
  std::vector<std::vector<double>> least(s.samples.size(),
                                         std::vector<double>(n, std::numeric_limits<double>::infinity()));
  for (SiteId x(0); x.index() < s.samples.size(); x = SiteId(x.value + 1)) {
    std::vector<double>& d = least[x.index()];
    d[surface.vertex_of[x].index()] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (VertexId v(0); v.index() < n; v = VertexId(v.value + 1))
        for (const VertexId w : surface.mesh.neighbours(v)) {
          const double there = d[w.index()] + (surface.mesh.position(v) - surface.mesh.position(w)).norm();
          if (there < d[v.index()]) d[v.index()] = there, changed = true;
        }
    }
  }
  for (VertexId v(0); v.index() < n; v = VertexId(v.value + 1)) {
    if (surface.mesh.facets_at(v).empty()) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& d : least) nearest = std::min(nearest, d[v.index()]);
    CHECK(regions.distance[v] == doctest::Approx(nearest));
    CHECK(least[regions.of[v].index()][v.index()] == doctest::Approx(nearest));
    const VertexId next = regions.next[v];
    CHECK(next.valid() == (regions.distance[v] > 0));
    if (next.valid()) CHECK(regions.of[next] == regions.of[v]);
  }
}

TEST_CASE("surface regions: long edges are split on the surface, where lengths are short the more") {
  const SampledScene s = scene("cube", 1, 40);
  SampledSurface surface = sampled(s);
  std::vector<double> wanted(s.samples.size(), 0.4);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (s.samples[i].position.z() > 0.5) wanted[i] = 0.1;
  split_long_edges(surface, wanted, 0.5, 100000);
  require_right(s, surface);
  require_curves(s, surface);
  double longest = 0, longest_above = 0;
  for (VertexId v(0); v.index() < surface.mesh.num_vertices(); v = VertexId(v.value + 1))
    for (const VertexId w : surface.mesh.neighbours(v)) {
      const double length = (surface.mesh.position(v) - surface.mesh.position(w)).norm();
      longest = std::max(longest, length);
      if (std::min(surface.mesh.position(v).z(), surface.mesh.position(w).z()) > 0.9)
        longest_above = std::max(longest_above, length);
    }
  CHECK(longest <= 0.2);
  CHECK(longest_above <= 0.1);
  SampledSurface few = sampled(s);
  split_long_edges(few, wanted, 0.01, 500);
  CHECK(few.mesh.num_vertices() == 500);
}
