#include "fpo/remesh/flips_towards.h"

#include <algorithm>

#include "fpo/remesh/better_flips.h"
#include "fpo/remesh/edited_mesh.h"

namespace fpo {

using geom::FacetId;
using geom::MeshEdge;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr int most_turns = 8;
constexpr double folded = 0;  // cosine between normals: edges between vertices of a remesh bend the surface

bool has(const std::vector<MeshEdge>& edges, VertexId a, VertexId b) {
  return std::ranges::binary_search(edges, geom::mesh_edge(a, b));
}

/// Each makes one edge more of the goal's.
std::size_t flip_to(const std::vector<MeshEdge>& goal, const std::vector<MeshEdge>& kept, EditedMesh& mesh) {
  std::size_t flips = 0;
  std::vector<MeshEdge> edges = geom::edges_of(mesh.mesh());
  for (; !edges.empty();) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    if (has(goal, a, b) || has(kept, a, b) || !mesh.can_flip(a, b)) continue;
    const FacetId t = mesh.beside(a, b), u = mesh.beside(b, a);
    if (!has(goal, mesh.third(t, a, b), mesh.third(u, a, b))) continue;
    const std::size_t edits = mesh.num_edits();
    const Vec3 before = mesh.normal(t) + mesh.normal(u);
    mesh.flip(a, b);
    if (mesh.normal(t).dot(before) < 0 || mesh.normal(u).dot(before) < 0) {  // turned over
      mesh.undo_to(edits);
      continue;
    }
    ++flips;
    for (const FacetId f : {t, u})
      for (std::size_t i = 0; i < 3; ++i)
        edges.push_back(geom::mesh_edge(mesh.facet(f)[i], mesh.facet(f)[(i + 1) % 3]));
  }
  mesh.keep();
  return flips;
}

}  // namespace

TriMesh flipped_towards(const TriMesh& mesh, const TriMesh& goal, const std::vector<MeshEdge>& kept) {
  EditedMesh edited(mesh);
  const std::vector<MeshEdge> wanted = geom::edges_of(goal);
  const BetterFlips others{[&](VertexId a, VertexId b) { return !has(wanted, a, b) && !has(kept, a, b); },
                           folded};
  for (int turn = 0; turn < most_turns; ++turn)
    if (flip_to(wanted, kept, edited) + make_better_flips(edited, others) == 0) break;
  return edited.mesh();
}

}  // namespace fpo
