#include "tools/measures.h"

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "tools/worded.h"

namespace tools {
namespace {

/// Vertices without a facet do not count.
fpo::Covering covering_of(const geom::TriMesh& mesh, const geom::TriMesh& reference, int threads) {
  std::vector<bool> used(mesh.num_vertices());
  for (const geom::TriMesh::Facet& f : mesh.facets())
    for (const geom::VertexId v : f) used[v.index()] = true;
  std::vector<geom::Vec3> samples;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) samples.push_back(geom::snapped(mesh.position(geom::VertexId(v))));
  return fpo::covering(reference, samples, fpo::nearest_distances(samples), threads);
}

/// No measure depends on the unit of length; in this one no square under- or overflows.
Measures measured(geom::TriMesh mesh, geom::TriMesh reference, bool compare, int threads,
                  const std::function<void(double)>& tell = {}) {
  constexpr double distance_share = 0.6;  // of the time
  const double factor = geom::factor_to_unit_box(mesh, reference);
  mesh = geom::scaled_to_unit_box(mesh, factor);
  reference = geom::scaled_to_unit_box(reference, factor);
  geom::require(!compare || reference.area() > 0, "the surface has no area");
  Measures m;
  m.topology = geom::topology(mesh);
  m.quality = fpo::quality(mesh, compare ? reference.area() : mesh.area());
  m.compared = compare;
  if (!compare) return m;
  m.distance = fpo::surface_distance(mesh, reference, threads);
  if (tell) tell(distance_share);
  const double percent = 100 / reference.diagonal();
  m.covering = covering_of(mesh, reference, threads);
  for (double* length : {&m.distance.max, &m.distance.max_bound, &m.distance.rms}) *length *= percent;
  return m;
}

}  // namespace

Measures measure(const geom::TriMesh& mesh) { return measured(mesh, {}, false, 1); }

Measures measure(const geom::TriMesh& mesh, const geom::TriMesh& reference, int threads,
                 const std::function<void(double)>& tell) {
  return measured(mesh, reference, true, threads, tell);
}

std::vector<std::pair<std::string, double>> named(const Measures& m) {
  const geom::Topology& t = m.topology;
  const fpo::Quality& q = m.quality;
  const auto count = [](auto value) { return static_cast<double>(value); };
  std::vector<std::pair<std::string, double>> values = {
      {"V", count(t.vertices)},
      {"F", count(t.facets)},
      {"E", count(t.edges)},
      {"euler", count(t.euler)},
      {"components", count(t.components)},
      {"boundary_edges", count(t.boundary_edges)},
      {"nonmanifold_edges", count(t.nonmanifold_edges)},
      {"nonmanifold_vertices", count(t.nonmanifold_vertices)},
      {"misoriented_edges", count(t.misoriented_edges)},
      {"unreferenced_vertices", count(t.unreferenced_vertices)},
      {"Qmin", q.q_min},
      {"Qavg", q.q_avg},
      {"theta_min", q.theta_min},
      {"theta_min_avg", q.theta_min_avg},
      {"theta_max", q.theta_max},
      {"theta_lt30_pct", q.theta_lt30_pct},
      {"V567_pct", q.v567_pct},
      {"delta", q.delta},
      {"mean_delta", q.delta_avg},
      {"delta_avg", q.delta_avg},
      {"edge_min", q.delta},
      {"edge_avg", q.edge_avg},
  };
  if (m.compared)
    values.insert(values.end(), {{"dH_pct", m.distance.max},
                                 {"dH_bound_pct", m.distance.max_bound},
                                 {"dRMS_pct", m.distance.rms},
                                 {"covering", m.covering.ratio},
                                 {"covering_local", m.covering.local_ratio}});
  return values;
}

std::string json(const std::vector<std::pair<std::string, double>>& values) {
  std::string text = "{";
  for (const auto& [name, value] : values)
    text += worded("%s\"%s\": %.9g", text.size() > 1 ? ", " : "", name.c_str(), value);
  return text + "}";
}

}  // namespace tools
