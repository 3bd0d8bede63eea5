#include "fpo/remesh/blends.h"

#include <algorithm>
#include <array>

#include "fpo/remesh/lengths.h"
#include "geom/disjoint_sets.h"

namespace fpo {

using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double error = 0.16;                                 // of the spacing
constexpr double says_much = 0.75;                             // of it: bends by a radian
constexpr double long_band = 4;                                // spacings: tips and corners are no bands
constexpr std::array<double, 2> least_lengths = {0.75, 0.85};  // of the spacing
constexpr double most_growth = 1.1;                            // of lengths elsewhere

using Marks = geom::Table<VertexId, char>;

/// Takes the mark from what is joined by mesh edges to no part that is so long.
void keep_bands(const TriMesh& mesh, double length, Marks& marked) {
  geom::DisjointSets sets(mesh.num_vertices());
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t e = 0; e < 3; ++e)
      if (marked[f[e]] && marked[f[(e + 1) % 3]]) sets.merge_to_least(f[e].index(), f[(e + 1) % 3].index());
  geom::Table<VertexId, std::array<Vec3, 2>> boxes(mesh.num_vertices());
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1)) {
    const VertexId root(sets.find(v.index()));  // the least: comes first
    const Vec3& x = mesh.position(v);
    if (root == v) boxes[v] = {x, x};
    boxes[root] = {boxes[root][0].cwiseMin(x), boxes[root][1].cwiseMax(x)};
  }
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1)) {
    const auto& [low, high] = boxes[VertexId(sets.find(v.index()))];
    if (!((high - low).norm() >= length)) marked[v] = 0;
  }
}

}  // namespace

std::optional<Sizing> sizing_beside_blends(const TriMesh& surface, const Features& features, std::size_t n,
                                           double gradation) {
  const auto is_crease = [](const FeatureCurve& curve) { return curve.sheets == 2; };
  if (std::ranges::none_of(features.curves, is_crease)) return {};
  const double spacing = hexagonal_spacing(surface.area(), n);
  const VertexField wanted = error_size(surface, features, error * spacing, spacing);
  Marks is_blend(surface.num_vertices(), 0);
  for (VertexId v(0); v.index() < wanted.size(); v = VertexId(v.value + 1))
    is_blend[v] = wanted[v] < says_much * spacing;
  keep_bands(surface, long_band * spacing, is_blend);
  if (std::ranges::none_of(is_blend, [](char marked) { return marked != 0; })) return {};
  for (const double least : least_lengths) {
    VertexField rho;
    for (VertexId v(0); v.index() < wanted.size(); v = VertexId(v.value + 1))
      rho.push_back(is_blend[v] ? std::max(wanted[v], least * spacing) : spacing);
    SizingLimits limits;
    limits.gradation = gradation;
    Sizing sizing = fit_sizing(surface, rho, n, limits);
    double longest = 0;
    for (std::size_t v = 0; v < surface.num_vertices(); ++v)
      longest = std::max(longest, sizing.at(VertexId(v)));
    if (longest < most_growth * spacing) return sizing;
  }
  return {};
}

}  // namespace fpo
