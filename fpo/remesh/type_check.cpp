#include "fpo/remesh/type_check.h"

#include <algorithm>
#include <set>

namespace fpo {

using geom::FacetId;
using geom::VertexId;

TypeCheck check_type(const geom::SurfaceType& input, const geom::TriMesh& remesh,
                     std::span<const SurfaceSample> samples) {
  TypeCheck check;
  const geom::Topology topology = geom::topology(remesh);
  check.nonmanifold_edges = topology.nonmanifold_edges;
  check.nonmanifold_vertices = topology.nonmanifold_vertices;
  check.bare_samples = topology.unreferenced_vertices;

  // Which parts of the input meet which of the remesh.
  const geom::SurfaceType output = geom::surface_type(remesh);
  std::vector<std::set<std::size_t>> outputs(input.parts.size()), inputs(output.parts.size());
  for (std::size_t t = 0; t < remesh.num_facets(); ++t)
    for (const VertexId v : remesh.facet(FacetId(t))) {
      const std::size_t from = input.part_of[samples[v.index()].facet], to = output.part_of[FacetId(t)];
      outputs[from].insert(to);
      inputs[to].insert(from);
    }
  std::set<std::size_t> parts;
  for (const std::set<std::size_t>& of : inputs)
    if (of.size() > 1) {
      ++check.joined_parts;
      parts.insert(of.begin(), of.end());
    }
  for (FacetId t(0); t.index() < remesh.num_facets(); t = FacetId(t.value + 1)) {
    if (!remesh.across(t, 0).valid() || remesh.across(t, 0) != remesh.across(t, 1)) continue;
    ++check.doubled_facets;  // two with two edges in common
    parts.insert(input.part_of[samples[remesh.facet(t)[0].index()].facet]);
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    check.lost_parts += outputs[i].empty();
    check.split_parts += outputs[i].size() > 1;
    const bool alone = outputs[i].size() == 1 && inputs[*outputs[i].begin()].size() == 1;
    const bool changed = alone && output.parts[*outputs[i].begin()] != input.parts[i];
    check.changed_parts += changed;
    if (outputs[i].size() != 1 || changed) parts.insert(i);
  }
  check.parts.assign(parts.begin(), parts.end());
  return check;
}

}  // namespace fpo
