// Remeshes by collapses: of the surface's type with as few samples as can be, the samples in place.

#include "fpo/remesh/collapsed_mesh.h"

#include <algorithm>
#include <atomic>

#include "doctest.h"
#include "fpo/remesh/flips_towards.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/sizing.h"
#include "geom/mesh/surface_type.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::VertexId;

namespace {

struct Collapsed {
  TriMesh surface;
  FeatureSamples of_features;
  std::vector<SurfaceSample> samples;
  std::optional<CollapsedMesh> found;
};

Collapsed collapse(const char* name, int size, std::size_t n, bool with_features = true) {
  Collapsed c{geom::make_shape(name, size), {}, {}, {}};
  Features features;
  if (with_features) features = find_features(c.surface);
  CurveSampling sampling;
  sampling.most = n;
  const Sizing sizing = Sizing::uniform(hexagonal_spacing(c.surface.area(), n));
  c.of_features = sample_features(c.surface, features, {}, sizing, sampling);
  c.samples = c.of_features.samples;
  const std::vector<SurfaceSample> others = random_samples(c.surface, n - c.samples.size(), 1);
  c.samples.insert(c.samples.end(), others.begin(), others.end());
  const std::vector<double> wanted(n, hexagonal_spacing(c.surface.area(), n));
  c.found = collapsed_mesh({c.surface, features, c.of_features, c.samples}, wanted);
  return c;
}

void require_right(const Collapsed& c) {
  REQUIRE(c.found.has_value());
  CHECK(c.found->mesh.num_vertices() == c.samples.size());
  CHECK(geom::topology(c.found->mesh).unreferenced_vertices == 0);
  CHECK(geom::topology(c.found->mesh).manifold());
  CHECK(geom::surface_type(c.found->mesh).parts == geom::surface_type(c.surface).parts);
  CHECK(broken_edges(c.found->mesh, c.of_features).empty());
  std::vector<SurfaceSample> samples = c.samples;
  for (const CollapsedMesh::Exchange& e : c.found->exchanged) {
    CHECK(e.x.index() >= c.of_features.samples.size());
    samples[e.x.index()] = e.place;
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
    CHECK((c.found->mesh.position(VertexId(i)) - samples[i].position).norm() < 1e-6 * c.surface.diagonal());
}

}  // namespace

TEST_CASE("collapsed mesh: of the surface's type, all samples and edges of curves there") {
  for (const auto& [name, size, n] : {std::tuple("sphere", 12, 60),
                                      {"torus", 16, 80},
                                      {"cube", 1, 150},
                                      {"gear", 0, 500},
                                      {"double-torus", 24, 120},
                                      {"hole-plate", 0, 700}}) {
    CAPTURE(std::string(name));
    require_right(collapse(name, size, static_cast<std::size_t>(n)));
  }
}

TEST_CASE("collapsed mesh: parts too thin for the samples keep their type, if need be by other samples") {
  std::size_t exchanged = 0;
  for (const auto& [name, n] : {std::pair("narrow-torus", 30),
                                {"thin-handle", 40},
                                {"dumbbell", 8},
                                {"horn", 40},
                                {"pinched-tube", 12},
                                {"double-torus", 16},
                                {"torus", 12},
                                {"plate", 40},
                                {"shell", 60}}) {
    CAPTURE(std::string(name));
    const Collapsed c = collapse(name, 0, static_cast<std::size_t>(n), false);
    require_right(c);
    exchanged += c.found->exchanged.size();
  }
  CHECK(exchanged > 0);
}

TEST_CASE("collapsed mesh: a torus needs seven vertices") {
  CHECK(!collapse("torus", 12, 6, false).found);
  require_right(collapse("torus", 12, 12, false));
}

TEST_CASE("collapsed mesh: interrupted there is none, and nothing is exchanged for all that are left") {
  const TriMesh surface = geom::make_shape("sphere", 60);
  const std::vector<SurfaceSample> samples = random_samples(surface, 100, 1);
  const std::atomic<bool> interrupted = true;
  CHECK(!collapsed_mesh({surface, {}, {}, samples}, std::vector<double>(100, 0.3), &interrupted));
  CHECK(collapsed_mesh({surface, {}, {}, samples}, std::vector<double>(100, 0.3)));
}

TEST_CASE("collapsed mesh: where samples are dense it is nearly the diagram's dual, and flips lead there") {
  const TriMesh surface = geom::make_shape("sphere", 24);
  RemeshOptions options = default_options(200, SizingKind::uniform);
  options.optimize.max_iterations = 10;
  const RemeshResult dual = remesh(surface, options);
  REQUIRE(dual.type.ok());
  const auto found = collapsed_mesh({surface, {}, {}, dual.samples}, dual.wanted);
  REQUIRE(found.has_value());
  CHECK(found->exchanged.empty());
  CHECK(flipped_towards(found->mesh, dual.mesh, {}).facets() == dual.mesh.facets());
}

TEST_CASE("flips towards: edges that are kept stay, and the type does, whatever the goal is") {
  const TriMesh a = geom::make_shape("torus", 8), b = geom::make_shape("torus", 8);
  geom::Table<FacetId, TriMesh::Facet> facets;  // a goal that is no surface
  for (const TriMesh::Facet& f : b.facets()) {
    TriMesh::Facet g;
    for (std::size_t i = 0; i < 3; ++i) g[i] = VertexId((f[i].index() * 5 + i / 2) % b.num_vertices());
    if (g[0] != g[2] && g[1] != g[2]) facets.push_back(g);
  }
  const TriMesh::Facet f = a.facet(FacetId(0));
  const std::vector<geom::MeshEdge> kept{geom::mesh_edge(f[0], f[1])};
  const TriMesh there = flipped_towards(a, TriMesh(b.vertices(), facets), kept);
  CHECK(geom::surface_type(there).parts == geom::surface_type(a).parts);
  CHECK(std::ranges::any_of(there.facets(), [&](const TriMesh::Facet& g) {
    return std::ranges::find(g, f[0]) != g.end() && std::ranges::find(g, f[1]) != g.end();
  }));
}
