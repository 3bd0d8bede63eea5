#include "fpo/remesh/trimmed_remesh.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/border_teeth.h"
#include "fpo/remesh/noise.h"
#include "fpo/remesh/remesh_task.h"
#include "geom/check.h"
#include "geom/mesh/submesh.h"

namespace fpo {

using geom::FacetId;
using geom::Submesh;
using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::array<Tooth, 2> teeth = {{{1.5, 75 * degree}, {2.5, 85 * degree}}};  // lengths in spacings
constexpr double small_angle = 30;

/// Nobody asked for features, nor for anything that names vertices of the surface.
bool may_be_trimmed(const RemeshOptions& options) {
  return may_be_smoothed(options) && options.features && options.features->yielding &&
         options.features->unmarked.empty();
}

bool is_good(const RemeshResult& result) {
  return result.type.ok() && result.broken_feature_edges == 0 && result.measures.theta_min >= small_angle;
}

bool is_worth_it(const RemeshResult& trimmed, const RemeshResult& whole) {
  if (!trimmed.type.ok() || !is_better(trimmed, whole)) return false;
  return !whole.type.ok() || 2 * trimmed.measures.angles_below_30 <= whole.measures.angles_below_30;
}

bool has_plain_borders(const TriMesh& surface) {
  const geom::Topology topology = geom::topology(surface);
  return topology.boundary_edges > 0 && topology.nonmanifold_edges == 0 && topology.misoriented_edges == 0;
}

/// The sizes at all vertices of the surface: at those cut off, those of vertices around.
VertexField on_whole(const TriMesh& surface, const Submesh& part, const VertexField& of_part) {
  VertexField result(surface.num_vertices(), 0.0);
  for (std::size_t i = 0; i < part.vertices.size(); ++i) result[part.vertices[i]] = of_part[VertexId(i)];
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const TriMesh::Facet& f : surface.facets())
      for (const VertexId v : f) {
        if (result[v] > 0) continue;
        for (const VertexId w : f) result[v] = std::max(result[v], result[w]);
        goes_on |= result[v] > 0;
      }
  }
  return result;
}

RemeshResult remesh_part(const TriMesh& surface, const Submesh& part, RemeshOptions options,
                         const RemeshFunction& remesh) {
  if (!options.rho.empty()) {
    VertexField rho;
    for (const VertexId v : part.vertices) rho.push_back(options.rho[v]);
    options.rho = std::move(rho);
  }
  RemeshResult result = remesh(part.mesh, options);
  for (SurfaceSample& x : result.samples) x.facet = part.facets[x.facet.index()];
  for (CellPolygon& cell : result.cells) cell.facet = part.facets[cell.facet.index()];
  result.sizing = on_whole(surface, part, result.sizing);
  if (!result.given_up.empty()) result.given_up += "; ";
  result.given_up +=
      "teeth of borders cut off: " + std::to_string(surface.num_facets() - part.facets.size()) +
      " facets; --features 45 keeps them";
  return result;
}

/// None if it is interrupted, or n is too small for what is left.
std::optional<RemeshResult> try_part(const TriMesh& surface, const Submesh& part,
                                     const RemeshOptions& options, const RemeshFunction& remesh) try {
  RemeshResult result = remesh_part(surface, part, options, remesh);
  if (interrupted(options.optimize.interrupted)) return {};
  return result;
} catch (const geom::Interrupted&) {
  return {};
} catch (const geom::InputError&) {
  return {};
}

/// In vain: then it is not all tried once more.
bool was_all_tried(const RemeshResult& result) { return !result.type.ok() || result.by_collapses; }

}  // namespace

RemeshResult remesh_trimmed_or_not(const TriMesh& surface, const RemeshOptions& options,
                                   const RemeshFunction& remesh) {
  RemeshResult best = remesh(surface, options);
  if (!may_be_trimmed(options) || is_good(best) || best.stood_in || !has_plain_borders(surface)) return best;
  const double spacing = even_spacing(surface, options);
  const RemeshOptions how = was_all_tried(best) ? in_the_way_of(best, options) : options;
  std::size_t left = surface.num_facets();
  for (const Tooth& tooth : teeth) {
    if (is_good(best) || interrupted(options.optimize.interrupted)) break;
    std::vector<FacetId> facets = without_teeth(surface, {tooth.longest * spacing, tooth.angle});
    if (std::exchange(left, facets.size()) == facets.size()) continue;
    std::optional<RemeshResult> other =
        try_part(surface, geom::submesh(surface, std::move(facets)), how, remesh);
    if (other && is_worth_it(*other, best)) best = std::move(*other);
  }
  return best;
}

}  // namespace fpo
