#include "geom/repair/copies.h"

#include <algorithm>
#include <memory>

#include "geom/mesh/aabb_tree.h"
#include "geom/repair/flat_facets.h"
#include "geom/repair/parts.h"

namespace geom {
namespace {

constexpr std::size_t most_copies_sought = 2000;
constexpr double most_of_area = 0.9;

using Vertices = Table<VertexId, Vec3>;
using Facets = Table<FacetId, TriMesh::Facet>;

Vec3 normal(const Vertices& vertices, const TriMesh::Facet& f) {
  return (vertices[f[1]] - vertices[f[0]]).cross(vertices[f[2]] - vertices[f[0]]);
}

/// A part that others may lie on.
class Sheet {
 public:
  Sheet(const Vertices& vertices, const Facets& facets, const MeshPart& part)
      : vertices_(vertices), facets_(facets), part_(part) {
    for (const FacetId t : part.facets)
      for (const VertexId v : facets[t]) box_.extend(vertices[v]);
  }

  bool may_hold(const Sheet& other, double distance) const {
    const Vec3 reach = Vec3::Constant(distance);
    return Box3(Vec3(box_.min() - reach), Vec3(box_.max() + reach)).contains(other.box_);
  }

  bool holds(const Sheet& other, double distance) {
    if (!tree_) plant();
    double same_way = 0, area = 0;
    FacetId hint(0);
    for (const FacetId t : other.part_.facets) {
      const TriMesh::Facet& f = facets_[t];
      Vec3 middle(0, 0, 0);
      for (const VertexId v : f) {
        const AabbTree::Closest closest = tree_->closest(vertices_[v], hint);
        if (!(closest.distance2 <= distance * distance)) return false;
        hint = closest.facet;
        middle += vertices_[v] / 3;
      }
      const Vec3 n = normal(vertices_, f);
      const FacetId below = part_.facets[tree_->closest(middle, hint).facet.index()];
      area += n.norm();
      if (n.dot(normal(vertices_, facets_[below])) > 0) same_way += n.norm();
    }
    return same_way > most_of_area * area;
  }

 private:
  void plant() {
    Vertices corners;
    Facets own;
    for (const FacetId t : part_.facets) {
      const VertexId first(corners.size());
      for (const VertexId v : facets_[t]) corners.push_back(Vec3(vertices_[v]));
      own.push_back({first, VertexId(first.value + 1), VertexId(first.value + 2)});
    }
    tree_ = std::make_unique<AabbTree>(TriMesh(std::move(corners), std::move(own)));
  }

  const Vertices& vertices_;
  const Facets& facets_;
  const MeshPart& part_;
  Box3 box_;
  std::unique_ptr<AabbTree> tree_;  ///< made when first needed
};

}  // namespace

std::size_t drop_copies(const Vertices& vertices, Facets& facets, double distance) {
  std::vector<MeshPart> parts = mesh_parts(vertices, facets);
  if (parts.size() < 2 || parts.size() > most_copies_sought) return 0;
  std::ranges::stable_sort(parts, std::ranges::greater(), &MeshPart::area);
  std::vector<Sheet> kept;
  Table<FacetId, char> marked(facets.size(), 0);
  std::size_t count = 0;
  for (const MeshPart& part : parts) {
    Sheet sheet(vertices, facets, part);
    const bool is_copy = std::ranges::any_of(
        kept, [&](Sheet& other) { return other.may_hold(sheet, distance) && other.holds(sheet, distance); });
    if (!is_copy) {
      kept.push_back(std::move(sheet));
      continue;
    }
    ++count;
    for (const FacetId t : part.facets) marked[t] = 1;
  }
  if (count > 0) drop_marked(marked, facets);
  return count;
}

}  // namespace geom
