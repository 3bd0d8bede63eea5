#include "fpo/features/fold_sides.h"

#include <cmath>
#include <map>
#include <optional>

namespace fpo {
namespace {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

/// A facet at a crease seen from the one across.
struct Side {
  Vec3 normal;
  double rises;  ///< the sine of the angle by which the facet across rises above this one's plane
};
using Sides = std::array<Side, 2>;

Vec3 third_corner(const TriMesh& mesh, FacetId t, VertexId a, VertexId b) {
  for (const VertexId v : mesh.facet(t))
    if (v != a && v != b) return mesh.position(v);
  return mesh.position(a);
}

std::optional<Sides> sides_of(const TriMesh& mesh, FacetId t, VertexId a, VertexId b) {
  for (int e = 0; e < 3; ++e) {
    const TriMesh::Facet& f = mesh.facet(t);
    const VertexId from = f[static_cast<std::size_t>(e)], to = f[static_cast<std::size_t>((e + 1) % 3)];
    if (!((from == a && to == b) || (from == b && to == a)) || !mesh.across(t, e).valid()) continue;
    const FacetId other = mesh.across(t, e);
    const Vec3 along = (mesh.position(b) - mesh.position(a)).normalized();
    const auto side = [&](FacetId s, FacetId beside) -> Side {
      Vec3 away = third_corner(mesh, beside, a, b) - mesh.position(a);
      away -= away.dot(along) * along;
      const Vec3 n = mesh.normal(s).normalized();
      return {n, n.dot(away.normalized())};
    };
    return Sides{side(t, other), side(other, t)};
  }
  return std::nullopt;
}

/// Seen from those two sides that face each other's way best: 1 if both edges are folded the same way, -1 if
/// not.
int agreement(const Sides& s, const Sides& t) {
  double best = 0;
  for (const Side& a : s)
    for (const Side& b : t)
      if (std::abs(a.normal.dot(b.normal)) > std::abs(best))
        best = std::copysign(a.normal.dot(b.normal), a.normal.dot(b.normal) * a.rises * b.rises);
  return best < 0 ? -1 : 1;
}

}  // namespace

FoldSides fold_sides(const TriMesh& mesh, const Features& features) {
  constexpr double least_sine = 0.087;
  struct AtVertex {
    std::size_t edges = 0;
    std::vector<Sides> folds;
  };
  std::map<VertexId, AtVertex> at;
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t i = 0; i < curve.facets.size(); ++i) {
      const VertexId a = curve.vertices[i], b = curve.vertices[(i + 1) % curve.vertices.size()];
      const std::optional<Sides> sides =
          curve.sheets == 2 ? sides_of(mesh, curve.facets[i], a, b) : std::nullopt;
      for (const VertexId v : {a, b}) {
        ++at[v].edges;
        if (sides && std::abs((*sides)[0].rises) >= least_sine) at[v].folds.push_back(*sides);
      }
    }
  FoldSides result;
  for (const auto& [v, here] : at) {
    if (here.edges != 2 || here.folds.size() != 2) continue;
    ++result.pairs;
    result.opposite += agreement(here.folds[0], here.folds[1]) < 0 ? 1 : 0;
  }
  return result;
}

bool is_noise(const FoldSides& sides) {
  constexpr std::size_t enough = 20, most_opposite = 15;  // percent
  return sides.pairs >= enough && 100 * sides.opposite > most_opposite * sides.pairs;
}

}  // namespace fpo
