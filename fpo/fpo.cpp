#include "fpo/fpo.h"

#include <algorithm>
#include <string>
#include <thread>

#include "fpo/remesh/at_least.h"
#include "fpo/remesh/crowd.h"
#include "fpo/remesh/refusal.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/barycentric.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/clean.h"
#include "geom/repair/parts.h"

namespace fpo {
namespace {

using Points = Eigen::Ref<const Eigen::MatrixXd>;
using Triangles = Eigen::Ref<const Eigen::MatrixXi>;

std::string size_of(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

void require_three_columns(const std::string& name, Eigen::Index rows, Eigen::Index columns) {
  geom::require(columns == 3, name + " is " + size_of(rows, columns) + ", not n x 3");
}

/// What is remeshed.
struct Input {
  geom::TriMesh mesh;
  std::vector<int> rows;  ///< of F, of the mesh's facets before anything was mended
  bool mended = false;    ///< facets of the mesh are no rows
};

bool names_twice(const Triangles& F, Eigen::Index t) {
  return F(t, 0) == F(t, 1) || F(t, 1) == F(t, 2) || F(t, 2) == F(t, 0);
}

/// Without facets that name a vertex twice, if it is to be clean.
Input rows_of(const Points& V, const Triangles& F, bool clean) {
  require_three_columns("V", V.rows(), V.cols());
  require_three_columns("F", F.rows(), F.cols());
  geom::require(F.rows() > 0, "F is empty");
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  vertices.reserve(static_cast<std::size_t>(V.rows()));
  for (Eigen::Index i = 0; i < V.rows(); ++i) vertices.push_back(V.row(i).transpose());
  geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
  facets.reserve(static_cast<std::size_t>(F.rows()));
  const auto corner = [&](Eigen::Index t, Eigen::Index i) { return geom::VertexId(std::int32_t{F(t, i)}); };
  Input input;
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    if (clean && names_twice(F, t)) continue;
    facets.push_back({corner(t, 0), corner(t, 1), corner(t, 2)});
    input.rows.push_back(static_cast<int>(t));
  }
  geom::require(!facets.empty(), "every facet names a vertex twice");
  input.mesh = geom::TriMesh(std::move(vertices), std::move(facets));
  return input;
}

Input input_of(const Points& V, const Triangles& F, bool clean) {
  Input input = rows_of(V, F, clean);
  if (!clean) return input;
  geom::Cleaned cleaned = geom::cleaned(input.mesh);
  input.mended = cleaned.done.any();
  input.mesh = std::move(cleaned.mesh);
  return input;
}

void set_sizes(const geom::TriMesh& input, const Eigen::VectorXd& sizes, RemeshOptions& options) {
  const auto n = static_cast<Eigen::Index>(input.num_vertices());
  geom::require(sizes.size() == n, "sizes has " + std::to_string(sizes.size()) + " numbers, V has " +
                                       std::to_string(n) + " vertices");
  for (Eigen::Index v = 0; v < n; ++v)
    geom::require(sizes[v] > 0, "size of vertex " + std::to_string(v) + " is not positive");
  options.rho.assign(sizes.begin(), sizes.end());
}

/// By lengths, if there is no number. The limits of wanted lengths are those of ratios.
void set_count(const geom::TriMesh& input, const Options& given, RemeshOptions& options) {
  const Lengths lengths{given.edge_length, given.error, given.radius};
  const bool has_length = given.edge_length || given.error || given.radius;
  const bool by_lengths = has_length || given.sizing == SizingKind::given;
  const bool disks = given.method == Method::mps || given.method == Method::cps;
  geom::require(
      !given.radius || (disks && !given.edge_length && !given.error && given.sizing == SizingKind::uniform),
      "a radius is for mps or cps, by itself");
  geom::require(!given.error || given.sizing == SizingKind::uniform, "error and sizing exclude each other");
  if (given.count > 0) geom::require(!has_length, "count and lengths exclude each other");
  if (given.count > 0 || !by_lengths) return;
  if (options.limits.smallest == SizingLimits{}.smallest) options.limits.smallest = 1e-6;
  if (options.limits.largest == SizingLimits{}.largest) options.limits.largest = 1e6;
  set_number_of_samples(input, lengths, options);
}

RemeshOptions remesh_options(const geom::TriMesh& input, const Options& given) {
  RemeshOptions options;
  geom::require(given.count <= max_samples, "the number of samples must be at most 20 million");
  options.num_samples = given.count;
  options.method = given.method;
  options.seed = given.seed;
  options.threads =
      given.threads > 0 ? given.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.sizing = given.sizing;
  options.limits = given.limits;
  if (given.sizing == SizingKind::given) set_sizes(input, given.sizes, options);
  options.features = given.features;
  require_three_columns("fixed", given.fixed.rows(), given.fixed.cols());
  for (Eigen::Index i = 0; i < given.fixed.rows(); ++i)
    options.fixed.push_back(given.fixed.row(i).transpose());
  options.shortest_edge_removal = given.shortest_edge_removal;
  options.mend = given.mend;
  options.sheets = given.sheets;
  options.maximal = given.maximal;
  options.surface.corners = given.corners;
  options.surface.farthest = given.farthest;
  options.coarse_start = given.coarse_start;
  if (given.min_angle) set_least_angle(options.angles, *given.min_angle);
  if (given.min_delta) options.angles.enough_delta = options.closer_delta = *given.min_delta;
  options.optimize.interrupted = given.interrupted;
  options.optimize.on_iteration = given.on_iteration;
  options.optimize.on_move = given.on_move;
  Choices choices{.scope = given.scope,
                  .weight_factor = given.weight_scale,
                  .iterations = given.iterations,
                  .tile_samples = given.tile_samples,
                  .optimize_angles = given.optimize_angles,
                  .improve_fidelity = given.improve_fidelity,
                  .come_closer = given.come_closer,
                  .rest = given.rest};
  use_effort(given.quality, options, choices);
  if (given.target_delta) options.optimize.target_delta = *given.target_delta;
  set_count(input, given, options);
  complete(options, choices);
  return options;
}

/// In the unit box, where no square of a length under- or overflows.
Quality quality_of(const geom::TriMesh& input, const geom::TriMesh& output) {
  if (output.num_facets() == 0) return {};
  const double factor = geom::factor_to_unit_box(input);
  return quality(geom::scaled(output, factor), geom::scaled(input, factor).area());
}

RemeshMeasures measures_of(const geom::TriMesh& input, const RemeshResult& result) {
  return {.quality = quality_of(input, result.mesh),
          .input = geom::topology(input),
          .output = geom::topology(result.mesh),
          .type = result.type,
          .given_up = result.given_up,
          .fit = result.fit,
          .optimization = result.optimization,
          .hidden = result.hidden,
          .broken_feature_edges = result.broken_feature_edges};
}

Eigen::VectorXd vector_of(const VertexField& field) {
  return Eigen::Map<const Eigen::VectorXd>(field.data(), static_cast<Eigen::Index>(field.size()));
}

void set_triangles(const geom::TriMesh& mesh, Eigen::MatrixXi& F) {
  F.resize(static_cast<Eigen::Index>(mesh.num_facets()), 3);
  Eigen::Index row = 0;
  for (const geom::TriMesh::Facet& facet : mesh.facets())
    F.row(row++) << facet[0].value, facet[1].value, facet[2].value;
}

/// The same samples by the nearest facets of the surface that was given. Scaled, where no square under- or
/// overflows.
std::vector<SurfaceSample> on_rows(const geom::TriMesh& surface, std::vector<SurfaceSample> samples) {
  const double factor = geom::factor_to_unit_box(surface);
  const geom::AabbTree tree(geom::scaled(surface, factor));
  for (SurfaceSample& x : samples) x.facet = tree.closest(factor * x.position).facet;
  return samples;
}

void set_places(const geom::TriMesh& input, const std::vector<int>& rows,
                const std::vector<SurfaceSample>& samples, Remesh& remesh) {
  const std::vector<geom::Vec3> barycentric = barycentric_coordinates(input, samples);
  const auto n = static_cast<Eigen::Index>(samples.size());
  remesh.facet.resize(n);
  remesh.barycentric.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    remesh.facet[i] = rows[samples[at].facet.index()];
    remesh.barycentric.row(i) = barycentric[at];
  }
}

}  // namespace

Remesh remesh(const Points& V, const Triangles& F, const Options& options) {
  const Input given = input_of(V, F, options.clean);
  const geom::TriMesh& input = given.mesh;
  RemeshOptions completed = remesh_options(input, options);
  refuse_soup(input, geom::mesh_parts(input.vertices(), input.facets()).size(), completed.num_samples);
  if (completed.sheets != Sheets::apart) refuse_crowd(input, completed.num_samples);
  if (!options.at_least && completed.sizing == SizingKind::uniform)
    refuse_thread(input, completed.num_samples);
  std::vector<IterationReport> iterations;
  completed.optimize.on_iteration = [&](const IterationReport& report) {
    if (report.iteration == 0) iterations.clear();  // the last of several runs counts
    iterations.push_back(report);
    if (options.on_iteration) options.on_iteration(report);
  };
  const RemeshResult result =
      options.at_least ? remesh_at_least(input, completed).remesh : remesh(input, completed);
  refuse_remnant(result.mesh, result.feature_bound.samples);
  Remesh remesh;
  remesh.V.resize(static_cast<Eigen::Index>(result.mesh.num_vertices()), 3);
  Eigen::Index row = 0;
  for (const geom::Vec3& x : result.mesh.vertices()) remesh.V.row(row++) = x;
  set_triangles(result.mesh, remesh.F);
  if (given.mended) {
    const geom::TriMesh before = rows_of(V, F, options.clean).mesh;
    set_places(before, given.rows, on_rows(before, result.samples), remesh);
  } else {
    set_places(input, given.rows, result.samples, remesh);
  }
  remesh.wanted = vector_of(result.wanted);
  remesh.sizing = vector_of(result.sizing);
  remesh.measures = measures_of(input, result);
  remesh.measures.converged =
      result.optimization.reason == StopReason::nothing_gained || stopped_gaining(iterations);
  return remesh;
}

}  // namespace fpo
