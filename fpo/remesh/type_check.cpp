#include "fpo/remesh/type_check.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace fpo {

using geom::FacetId;
using geom::VertexId;

namespace {

/// Edges with more triangles than two, where they are not to be so many, or with others than are to be.
std::size_t num_wrong_edges(const geom::TriMesh& mesh, const BranchEdges& branches) {
  std::map<geom::MeshEdge, std::size_t> facets;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t e = 0; e < 3; ++e) {
      const geom::MeshEdge edge = geom::mesh_edge(mesh.facet(t)[e], mesh.facet(t)[(e + 1) % 3]);
      if (!mesh.across(t, static_cast<int>(e)).valid() || branches.contains(edge)) ++facets[edge];
    }
  return static_cast<std::size_t>(std::ranges::count_if(facets, [&](const auto& edge) {
    const auto branch = branches.find(edge.first);
    return branch == branches.end() ? edge.second > 2 : edge.second != branch->second;
  }));
}

void compare_pieces(const WantedType& input, const geom::TriMesh& remesh, TypeCheck& check) {
  const std::vector<geom::PartType> pieces = geom::pieces_between_branches(remesh);
  std::vector<geom::PartType> lost, others;
  std::ranges::set_difference(input.pieces, pieces, std::back_inserter(lost));
  std::ranges::set_difference(pieces, input.pieces, std::back_inserter(others));
  check.lost_pieces = lost.size();
  check.new_pieces = others.size();
}

}  // namespace

TypeCheck check_type(const WantedType& input, const geom::TriMesh& remesh, std::span<const FacetId> facets) {
  TypeCheck check;
  const geom::Topology topology = geom::topology(remesh);
  check.nonmanifold_edges = topology.nonmanifold_edges;
  check.nonmanifold_vertices = topology.nonmanifold_vertices;
  check.bare_samples = topology.unreferenced_vertices;
  if (!input.branch_edges.empty()) {
    check.nonmanifold_edges = num_wrong_edges(remesh, input.branch_edges);
    check.nonmanifold_vertices = find_defects(remesh, input.branch_edges).size() - check.bare_samples;
  }
  if (!input.pieces.empty()) compare_pieces(input, remesh, check);

  // Which parts of the input meet which of the remesh.
  const geom::SurfaceType output = geom::surface_type(remesh);
  std::vector<std::set<std::size_t>> outputs(input.parts.size()), inputs(output.parts.size());
  for (std::size_t t = 0; t < remesh.num_facets(); ++t)
    for (const VertexId v : remesh.facet(FacetId(t))) {
      const std::size_t from = input.part_of[facets[v.index()]], to = output.part_of[FacetId(t)];
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
    parts.insert(input.part_of[facets[remesh.facet(t)[0].index()]]);
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

TypeCheck check_type(const WantedType& input, const geom::TriMesh& remesh,
                     std::span<const SurfaceSample> samples) {
  std::vector<FacetId> facets;
  facets.reserve(samples.size());
  for (const SurfaceSample& sample : samples) facets.push_back(sample.facet);
  return check_type(input, remesh, facets);
}

}  // namespace fpo
