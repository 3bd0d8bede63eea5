#include "fpo/remesh/flips_towards.h"

#include <algorithm>

#include "fpo/remesh/better_flips.h"
#include "fpo/remesh/edited_mesh.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr int most_turns = 8;
constexpr double folded = 0;  // cosine between normals: edges between vertices of a remesh bend the surface

VertexPairs edges_of(const TriMesh& mesh) {
  VertexPairs edges;
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(std::minmax(f[i], f[(i + 1) % 3]));
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

bool has(const VertexPairs& edges, VertexId a, VertexId b) {
  return std::ranges::binary_search(edges, VertexPairs::value_type(std::minmax(a, b)));
}

/// Each makes one edge more of the goal's.
std::size_t flip_to(const VertexPairs& goal, const VertexPairs& kept, EditedMesh& mesh) {
  std::size_t flips = 0;
  VertexPairs edges = edges_of(mesh.mesh());
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
        edges.emplace_back(std::minmax(mesh.facet(f)[i], mesh.facet(f)[(i + 1) % 3]));
  }
  mesh.keep();
  return flips;
}

}  // namespace

TriMesh flipped_towards(const TriMesh& mesh, const TriMesh& goal, const VertexPairs& kept) {
  EditedMesh edited(mesh);
  const VertexPairs wanted = edges_of(goal);
  const BetterFlips others{[&](VertexId a, VertexId b) { return !has(wanted, a, b) && !has(kept, a, b); },
                           folded};
  for (int turn = 0; turn < most_turns; ++turn)
    if (flip_to(wanted, kept, edited) + make_better_flips(edited, others) == 0) break;
  return edited.mesh();
}

}  // namespace fpo
