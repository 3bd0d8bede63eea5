#include "fpo/features/feature_samples.h"

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/edges.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

RemeshResult remesh_with_features(const TriMesh& mesh, std::size_t n, std::vector<Vec3> fixed = {}) {
  RemeshOptions options;
  options.num_samples = n;
  options.optimize.max_iterations = 6;
  options.features = automatic_features();
  options.fixed = std::move(fixed);
  return remesh(mesh, options);
}

}  // namespace

TEST_CASE("feature samples: never more than allowed, and exactly the least number that an error names") {
  for (const char* name : {"cube", "l-block", "frame", "cylinder", "square", "moebius"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    const Features features = find_features(mesh);
    const std::size_t least = least_number_of_samples(mesh, features, {});
    CHECK(least >= features.corners.size());
    const Sizing fine = Sizing::uniform(mesh.diagonal() / 100);
    for (const std::size_t most : {least, least + 1, least + 20}) {
      const FeatureSamples samples = sample_features(mesh, features, {}, fine, {most, 1});
      CHECK(samples.samples.size() <= most);
      CHECK(samples.samples.size() >= least);
      CHECK(samples.chains.size() == features.curves.size());
    }
    CHECK_THROWS_WITH_AS(sample_features(mesh, features, {}, fine, {least - 1, 1}),
                         doctest::Contains(("at least " + std::to_string(least)).c_str()), geom::InputError);
  }
}

TEST_CASE("feature samples: fixed points keep their bits, divide curves") {
  const TriMesh cube = geom::make_shape("cube");
  const std::vector<Vec3> points{Vec3(0.3, 0, 0), Vec3(0.25, 0.6, 1)};
  const RemeshResult result = remesh_with_features(cube, 120, points);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(result.mesh.position(geom::VertexId(i)) == points[i]);
  CHECK(result.broken_feature_edges == 0);
  CHECK(result.mesh.num_vertices() == 120);
}

TEST_CASE(
    "feature samples: a remesh has the shape's topology, all chains as edges, all corners as vertices, where "
    "there is room") {
  struct Case {
    const char* name;
    std::size_t n;
  };
  for (const Case& shape : {Case{"cube", 60},
                            {"l-block", 60},
                            {"frame", 80},
                            {"cylinder", 80},
                            {"cone", 80},
                            {"square", 40},
                            {"triangle", 40},
                            {"tube", 80},
                            {"moebius", 100},
                            {"wave-disk", 80},
                            {"two-spheres", 120},
                            {"thin-plate", 300}}) {
    CAPTURE(shape.name);
    const TriMesh mesh = geom::make_shape(shape.name, shape.name == std::string("thin-plate") ? 2 : 12);
    const RemeshResult result = remesh_with_features(mesh, shape.n);
    const geom::Topology topology = geom::topology(result.mesh);
    const geom::ShapeInfo& info = geom::shape_info(shape.name);
    CHECK(result.mesh.num_vertices() == shape.n);
    CHECK(topology.manifold());
    CHECK(topology.unreferenced_vertices == 0);
    CHECK(topology.euler == info.euler);
    CHECK(topology.components == info.components);
    CHECK(topology.boundary_loops == info.boundary_loops);
    CHECK((result.feature_edges > 0) == (shape.name != std::string("two-spheres")));
    CHECK(result.broken_feature_edges == 0);
    const bool is_too_thin = shape.name == std::string("thin-plate");  // one edge of each side must do
    CHECK(result.given_up.empty() == !is_too_thin);
    if (is_too_thin) CHECK(result.measures.theta_min >= 30);
    for (const geom::VertexId corner : find_features(mesh, automatic_features()).corners)
      if (!is_too_thin) CHECK(std::ranges::count(result.mesh.vertices(), mesh.position(corner)) == 1);
    const geom::AabbTree tree(mesh);
    for (const Vec3& x : result.mesh.vertices()) CHECK(tree.closest(x).distance2 < 1e-24);
  }
}

TEST_CASE("feature samples: components of very different size keep their number") {
  auto vertices = fixtures::blob(8).vertices();
  auto facets = fixtures::blob(8).facets();
  const std::size_t count = vertices.size(), num_facets = facets.size();
  for (std::size_t v = 0; v < count; ++v)
    vertices.push_back(0.1 * vertices[geom::VertexId(v)] + Vec3(3, 0, 0));
  for (std::size_t t = 0; t < num_facets; ++t) {
    TriMesh::Facet f = facets[geom::FacetId(t)];
    for (geom::VertexId& v : f) v = geom::VertexId(v.index() + count);
    facets.push_back(f);
  }
  const RemeshResult result = remesh_with_features(TriMesh(vertices, facets), 800);
  const geom::Topology topology = geom::topology(result.mesh);
  CHECK(topology.manifold());
  CHECK(topology.components == 2);
  CHECK(topology.euler == 4);
}

TEST_CASE("feature samples: around a corner with a small angle the first samples are on a sphere") {
  for (const char* name : {"wedge", "star"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    const Features features = find_features(mesh);
    const Sizing sizing = Sizing::uniform(mesh.diagonal() / 40);
    const FeatureSamples samples = sample_features(mesh, features, {}, sizing, {5000, 1});
    std::size_t acute = 0;
    for (std::size_t c = 0; c < features.curves.size(); ++c)
      for (std::size_t d = 0; d < c; ++d)
        for (const bool c_ends : {false, true})
          for (const bool d_ends : {false, true}) {
            const auto &p = samples.chains[c], &q = samples.chains[d];
            const geom::SiteId corner = c_ends ? p.back() : p.front();
            if (corner != (d_ends ? q.back() : q.front())) continue;
            const auto first = [&](const std::vector<geom::SiteId>& chain, bool ends) -> Vec3 {
              const geom::SiteId x = ends ? chain[chain.size() - 2] : chain[1];
              return samples.samples[x.index()].position - samples.samples[corner.index()].position;
            };
            const Vec3 u = first(p, c_ends), v = first(q, d_ends);
            if (u.dot(v) <= 0.5 * u.norm() * v.norm()) continue;
            ++acute;
            CHECK(u.norm() == doctest::Approx(v.norm()).epsilon(1e-9));
            CHECK(u.norm() < 1.5 * sizing.at(geom::VertexId(0)));
          }
    CHECK(acute == (name == std::string("wedge") ? 2u : 10u));
  }
}

TEST_CASE("feature samples: edges on borders are as long as those inside") {
  for (const char* name : {"square", "tube", "moebius", "wave-disk"}) {
    CAPTURE(name);
    const RemeshResult result = remesh_with_features(geom::make_shape(name), 300);
    const std::size_t on_border = result.feature_samples;
    double sum[2] = {0, 0};  // of edges on borders, of those that do not touch them
    std::size_t number[2] = {0, 0};
    for (const auto& [a, b] : geom::edges_of(result.mesh)) {
      const bool is_at_a = a.index() < on_border, is_at_b = b.index() < on_border;
      if (is_at_a != is_at_b) continue;
      sum[!is_at_a] += (result.mesh.position(a) - result.mesh.position(b)).norm();
      ++number[!is_at_a];
    }
    REQUIRE((number[0] > 40 && number[1] > 300));
    const double ratio = sum[0] * static_cast<double>(number[1]) / (sum[1] * static_cast<double>(number[0]));
    CHECK(ratio > 0.95);
    CHECK(ratio < 1.05);
  }
}

TEST_CASE("feature samples: machined shapes keep all edges and have no angle below those of their corners") {
  struct Case {
    const char* name;
    std::size_t n;
    double least_angle;
  };
  for (const Case& shape : {Case{"wedge", 250, 14.9}, Case{"star", 400, 20}}) {
    CAPTURE(shape.name);
    RemeshOptions options;
    options.num_samples = shape.n;
    options.optimize.max_iterations = 10;
    options.features = automatic_features();
    const TriMesh mesh = geom::make_shape(shape.name);
    const RemeshResult result = remesh(mesh, options);
    CHECK(result.broken_feature_edges == 0);
    CHECK(result.crease_edges == result.feature_edges);
    CHECK(geom::topology(result.mesh).manifold());
    CHECK(geom::topology(result.mesh).euler == 2);
    CHECK(quality(result.mesh, mesh.area()).theta_min >= shape.least_angle);
  }
}
