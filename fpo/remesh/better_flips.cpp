#include "fpo/remesh/better_flips.h"

#include <algorithm>
#include <array>
#include <vector>

#include "fpo/remesh/facet_region.h"

namespace fpo {

using geom::FacetId;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double turned = 0.5;  // the cosine between normals before and after

using Edge = std::array<VertexId, 2>;

class Flipper {
 public:
  Flipper(EditedMesh& mesh, const BetterFlips& how) : mesh_(mesh), how_(how) {}

  void look_at(FacetId t) {
    const EditedMesh::Facet f = mesh_.facet(t);
    for (std::size_t i = 0; i < 3; ++i) edges_.push_back({f[i], f[(i + 1) % 3]});
  }

  std::size_t run() {
    std::size_t flips = 0;
    while (!edges_.empty()) {
      const auto [a, b] = edges_.back();
      edges_.pop_back();
      flips += flip_if_better(a, b);
    }
    return flips;
  }

 private:
  bool flip_if_better(VertexId a, VertexId b) {
    const FacetId t = mesh_.beside(a, b), u = mesh_.beside(b, a);
    if (!t.valid() || !u.valid() || !how_.is_allowed(a, b) || !mesh_.can_flip(a, b)) return false;
    const double least_t = least_angle(mesh_, t), least_u = least_angle(mesh_, u);
    const Vec3 normal_t = mesh_.normal(t), normal_u = mesh_.normal(u);
    const bool are_facets = least_t > least_with_normal && least_u > least_with_normal;
    if (are_facets && normal_t.dot(normal_u) < how_.folded * normal_t.norm() * normal_u.norm()) return false;
    const std::size_t edits = mesh_.num_edits();
    mesh_.flip(a, b);
    const Vec3 before = normal_t + normal_u;
    const bool is_better =
        std::min(least_angle(mesh_, t), least_angle(mesh_, u)) > std::min(least_t, least_u) &&
        std::ranges::all_of(std::array{t, u}, [&](FacetId f) {
          return mesh_.normal(f).dot(before) > turned * mesh_.normal(f).norm() * before.norm();
        });
    if (!is_better) return mesh_.undo_to(edits), false;
    mesh_.keep();
    look_at(t);
    look_at(u);
    return true;
  }

  EditedMesh& mesh_;
  const BetterFlips& how_;
  std::vector<Edge> edges_;
};

}  // namespace

std::size_t make_better_flips(EditedMesh& mesh, VertexId v, const BetterFlips& how) {
  Flipper flipper(mesh, how);
  for (const FacetId t : mesh.facets_at(v)) flipper.look_at(t);
  return flipper.run();
}

std::size_t make_better_flips(EditedMesh& mesh, const BetterFlips& how) {
  Flipper flipper(mesh, how);
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    if (mesh.has_facet(t)) flipper.look_at(t);
  return flipper.run();
}

}  // namespace fpo
