#include "fpo/surface/cut_edges.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "geom/mesh/scaling.h"

namespace fpo {
namespace {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

using Edge = std::pair<VertexId, VertexId>;  // the smaller id first

class CutEdges {
 public:
  CutEdges(const TriMesh& mesh, std::span<const EdgeCut> cuts) : positions_(mesh.vertices()) {
    std::map<Edge, std::set<double>> shares;
    for (const auto& [edge, share] : cuts) {
      const Edge ascending = std::minmax(edge[0], edge[1]);
      shares[ascending].insert(edge[0] == ascending.first ? share : 1 - share);
    }
    std::set<Edge> edges;
    for (const TriMesh::Facet& f : mesh.facets())
      for (std::size_t e = 0; e < 3; ++e)
        if (const Edge edge = std::minmax(f[e], f[(e + 1) % 3]); shares.contains(edge)) edges.insert(edge);
    for (const Edge& edge : edges) cut(edge, shares[edge]);
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
      add(mesh.facet(t));
      parents_.resize(facets_.size(), t);
    }
  }

  SplitSurface take() {
    return {TriMesh(std::move(positions_), std::move(facets_)), {}, std::move(parents_)};
  }

 private:
  void cut(const Edge& edge, const std::set<double>& shares) {
    const auto [a, b] = edge;
    std::vector<VertexId> chain{a};
    for (const double share : shares) {
      chain.push_back(positions_.next_id());
      positions_.push_back(geom::snapped(Vec3(positions_[a] + share * (positions_[b] - positions_[a]))));
    }
    chain.push_back(b);
    // All that a facet at the edge may come to ask for, cut from whichever end.
    for (std::size_t i = 0; i < chain.size(); ++i)
      for (std::size_t j = i + 2; j < chain.size(); ++j) {
        within_[{chain[i], chain[j]}] = chain[i + 1];
        within_[{chain[j], chain[i]}] = chain[j - 1];
      }
  }

  /// With all its parts.
  void add(const TriMesh::Facet& f) {
    for (std::size_t e = 0; e < 3; ++e) {
      const VertexId a = f[e], b = f[(e + 1) % 3], c = f[(e + 2) % 3];
      const auto within = within_.find({a, b});
      if (within == within_.end()) continue;
      add({a, within->second, c});
      add({within->second, b, c});
      return;
    }
    facets_.push_back(f);
  }

  std::map<Edge, VertexId> within_;  ///< edges that are cut: where, nearest to the first end
  Table<VertexId, Vec3> positions_;
  Table<FacetId, TriMesh::Facet> facets_;
  Table<FacetId, FacetId> parents_;
};

}  // namespace

SplitSurface with_cut_edges(const TriMesh& mesh, std::span<const EdgeCut> cuts) {
  return CutEdges(mesh, cuts).take();
}

VertexField on_cut_edges(const TriMesh& mesh, const SplitSurface& cut, VertexField field) {
  const Sizing linear(mesh, field);
  field.resize(cut.mesh.num_vertices());
  for (FacetId t(0); t.index() < cut.mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : cut.mesh.facet(t))
      if (v.index() >= mesh.num_vertices()) field[v] = linear.at({cut.mesh.position(v), cut.parents[t]});
  return field;
}

}  // namespace fpo
