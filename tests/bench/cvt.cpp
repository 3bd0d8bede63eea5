// What the facets of a coarse surface cost a centroidal Voronoi tessellation: its quality on a model, and on
// the smooth surface that the model stands for (Loop subdivision).
//   bench-cvt [MODEL N [SEEDS [ITERATIONS]]]   by default eight 1700 with 4 seeds and 300 iterations; the
//   model is a closed surface NAME.obj in the folder named by FPO_MODELS (default ../shared/models)
// One row a seed, for the model as it is and after two steps: Q_min, Q_avg, angles, d_H in percent.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "fpo/remesh/remesh_defaults.h"
#include "io/mesh_io.h"
#include "tests/bench/models.h"
#include "tools/measures.h"

namespace {

using geom::Vec3;
using geom::VertexId;

/// The corners across an edge, summed up, and the vertex in its middle.
struct Edge {
  Vec3 across{0, 0, 0};
  VertexId middle;
};
using Edges = std::map<std::pair<VertexId, VertexId>, Edge>;

Edge& edge(Edges& edges, VertexId a, VertexId b) { return edges[std::minmax(a, b)]; }

/// One step of Loop's rules (C. Loop, Smooth subdivision surfaces based on triangles, 1987), of a mesh
/// without border.
geom::TriMesh subdivided(const geom::TriMesh& mesh) {
  Edges edges;
  geom::Table<VertexId, std::set<VertexId>> rings;
  rings.assign(mesh.num_vertices(), {});
  for (const auto& t : mesh.facets())
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = t[k], b = t[(k + 1) % 3];
      edge(edges, a, b).across += mesh.position(t[(k + 2) % 3]);
      rings[a].insert(b);
    }
  geom::Table<VertexId, Vec3> vertices;
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) {
    const std::set<VertexId>& ring = rings[VertexId(i)];
    const double n = static_cast<double>(ring.size());
    const double c = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4, share = 5.0 / 8 - c * c;
    Vec3 sum(0, 0, 0);
    for (const VertexId v : ring) sum += mesh.position(v);
    vertices.push_back(ring.empty() ? mesh.position(VertexId(i))
                                    : Vec3((1 - share) * mesh.position(VertexId(i)) + share / n * sum));
  }
  for (auto& [ends, e] : edges) {
    e.middle = VertexId(vertices.size());
    vertices.push_back(
        Vec3(3.0 / 8 * (mesh.position(ends.first) + mesh.position(ends.second)) + e.across / 8));
  }
  geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
  for (const auto& t : mesh.facets()) {
    const VertexId ab = edge(edges, t[0], t[1]).middle, bc = edge(edges, t[1], t[2]).middle,
                   ca = edge(edges, t[2], t[0]).middle;
    for (const geom::TriMesh::Facet& part :
         {geom::TriMesh::Facet{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}})
      facets.push_back(part);
  }
  return geom::TriMesh(std::move(vertices), std::move(facets));
}

void row(const geom::TriMesh& mesh, const std::string& name, std::size_t n, std::uint64_t seed,
         int iterations) {
  fpo::RemeshOptions options = fpo::default_options(n, fpo::SizingKind::uniform);
  fpo::use_method(options, fpo::Method::cvt);
  options.seed = seed;
  options.optimize.max_iterations = iterations;
  const fpo::RemeshResult result = fpo::remesh(mesh, options);
  const tools::Measures m = tools::measure(result.mesh, mesh, 1);
  std::printf("%-24s seed %2d  %.3f %.4f  %.1f %.1f  d_H %.3f\n", name.c_str(), static_cast<int>(seed),
              m.quality.q_min, m.quality.q_avg, m.quality.theta_min, m.quality.theta_max, m.distance.max);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string model = argc > 2 ? argv[1] : "eight";
  const std::size_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1700;
  const int seeds = argc > 3 ? std::atoi(argv[3]) : 4, iterations = argc > 4 ? std::atoi(argv[4]) : 300;
  const auto file = bench::model_file(model);
  if (!std::filesystem::exists(file)) return std::printf("missing: %s\n", file.c_str()), 0;
  const geom::TriMesh mesh = io::read_mesh(file), smooth = subdivided(subdivided(mesh));
  for (int seed = 1; seed <= seeds; ++seed) {
    row(mesh, model, n, static_cast<std::uint64_t>(seed), iterations);
    row(smooth, model + ", subdivided", n, static_cast<std::uint64_t>(seed), iterations);
  }
}
