#include "fpo/remesh/coarse_start.h"

#include "fpo/remesh/stand_in.h"

namespace fpo {
namespace {

constexpr std::size_t dense = 30, dense_for_all = 45;  // facets a sample
constexpr std::size_t fewer = 2;                       // times
constexpr StandInEdges edges = {.collapsed = 0.4, .made = 0.53},
                       edges_for_all = {.collapsed = 0.3, .made = 0.4};
constexpr int last_iterations = 10;

VertexField lengths(const geom::TriMesh& surface, const Sizing& sizing) {
  VertexField all;
  for (geom::VertexId v(0); v.index() < surface.num_vertices(); v = geom::VertexId(v.value + 1))
    all.push_back(sizing.at(v));
  return all;
}

std::optional<geom::TriMesh> with_fewer_facets(const geom::TriMesh& surface, const Sizing& sizing,
                                               const StandInEdges& edges) {
  geom::TriMesh coarse = stand_in(surface, lengths(surface, sizing), edges);
  if (fewer * coarse.num_facets() > surface.num_facets()) return {};
  return coarse;
}

}  // namespace

std::optional<geom::TriMesh> coarse_surface(const geom::TriMesh& surface, const Sizing& sizing,
                                            std::size_t n) {
  if (surface.has_levels() || surface.num_facets() < dense * n) return {};
  return with_fewer_facets(surface, sizing, edges);
}

bool is_dense_for_all(const geom::TriMesh& surface, std::size_t n) {
  return surface.num_facets() >= dense_for_all * n;
}

std::optional<geom::TriMesh> coarse_surface_for_all(const geom::TriMesh& surface, const Sizing& sizing,
                                                    std::size_t n) {
  if (surface.has_levels() || !is_dense_for_all(surface, n)) return {};
  auto finer = with_fewer_facets(surface, sizing, edges_for_all);
  return finer ? std::move(finer) : with_fewer_facets(surface, sizing, edges);
}

Sizing sizing_on(const geom::TriMesh& coarse, const Sizing& sizing) {
  return sizing.is_uniform() ? sizing : Sizing(coarse, lengths(coarse, sizing));
}

bool has_two_parts(const OptimizeOptions& whole) { return whole.max_iterations >= 2 * last_iterations; }

OptimizeOptions first_part(OptimizeOptions whole) {
  whole.max_iterations -= last_iterations;
  return whole;
}

OptimizeOptions last_part(const OptimizeOptions& whole, const OptimizeResult& first) {
  OptimizeOptions last = whole;
  last.max_iterations -= first.last.iteration;
  if (whole.on_iteration)
    last.on_iteration = [whole, first](IterationReport report) {
      if (report.iteration == 0) return;  // that of the last one before, or nearly
      report.iteration += first.last.iteration;
      report.seconds += first.last.seconds;
      whole.on_iteration(report);
    };
  if (whole.on_move) last.on_move = [whole, first](std::size_t move) { whole.on_move(first.moves + move); };
  return last;
}

OptimizeResult both_parts(const OptimizeResult& first, OptimizeResult last) {
  last.moves += first.moves;
  last.last.iteration += first.last.iteration;
  last.last.seconds += first.last.seconds;
  return last;
}

}  // namespace fpo
