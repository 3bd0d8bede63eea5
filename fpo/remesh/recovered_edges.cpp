#include "fpo/remesh/recovered_edges.h"

#include <algorithm>
#include <vector>

#include "fpo/measure/triangle_angles.h"
#include "fpo/remesh/edited_mesh.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr int passes_for_edges = 8;  // through the edges that are missing: one may make room for another

using ChainEdge = std::pair<VertexId, VertexId>;

class Recovery {
 public:
  Recovery(const TriMesh& remesh, const FeatureSamples& features)
      : mesh_(remesh), chains_(chain_edges(features)) {}

  bool make(ChainEdge edge) { return make(edge, false) || make(edge, true); }
  TriMesh mesh() const { return mesh_.mesh(); }

 private:
  /// How an edge is made.
  struct Way {
    VertexId a, b;
    int most;                      ///< flips
    bool may_part;                 ///< other edges of chains, which are made again
    std::vector<FacetId> changed;  ///< so far
    std::vector<ChainEdge> parted;
  };

  bool is_on_chain(VertexId a, VertexId b) const {
    return std::ranges::binary_search(chains_, ChainEdge(std::minmax(a, b)));
  }

  /// By as few flips as do.
  bool make(ChainEdge edge, bool may_part) {
    const auto& [a, b] = edge;
    if (mesh_.has_edge(a, b)) return true;
    for (int flips = 1; flips <= (may_part ? most_parting : most_flips); ++flips) {
      Way there{a, b, flips, may_part, {}, {}}, back{b, a, flips, may_part, {}, {}};
      if (flip_on(there, flips) || flip_on(back, flips)) return true;
    }
    return false;
  }

  /// Flips edges opposite to a, the last one of which parts a and b. If that takes many, only those at
  /// samples that are joined to both.
  bool flip_on(Way& way, int flips) {
    const std::vector<FacetId> around = mesh_.facets_at(way.a);
    for (const FacetId t : around) {
      const EditedMesh::Facet f = mesh_.facet(t);
      const std::size_t i = f[0] == way.a ? 0 : f[1] == way.a ? 1 : 2;
      const VertexId from = f[(i + 1) % 3], to = f[(i + 2) % 3];
      const bool parts = is_on_chain(from, to);
      if ((parts && !way.may_part) || !mesh_.can_flip(from, to)) continue;
      if (way.most > freely && !mesh_.has_edge(from, way.b) && !mesh_.has_edge(to, way.b)) continue;
      const FacetId across = mesh_.beside(to, from);
      if ((mesh_.third(across, from, to) == way.b) != (flips == 1)) continue;
      const std::size_t before = mesh_.num_edits();
      mesh_.flip(from, to);
      way.changed.push_back(t), way.changed.push_back(across);
      if (parts) way.parted.emplace_back(std::minmax(from, to));
      if (flips > 1 ? flip_on(way, flips - 1) : is_good(way)) return true;
      way.changed.resize(way.changed.size() - 2);
      if (parts) way.parted.pop_back();
      mesh_.undo_to(before);
    }
    return false;
  }

  bool is_good(const Way& way) {
    for (const ChainEdge& edge : way.parted)
      if (!make(edge, false)) return false;
    return mesh_.has_edge(way.a, way.b) &&
           std::ranges::all_of(way.changed, [&](FacetId t) { return is_sound(t); });
  }

  bool is_sound(FacetId t) const {
    const EditedMesh::Facet& f = mesh_.facet(t);
    if (std::ranges::min(angles_of({mesh_.position(f[0]), mesh_.position(f[1]), mesh_.position(f[2])})) <
        least_angle)
      return false;
    const Vec3 normal = mesh_.normal(t).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId from = f[i], to = f[(i + 1) % 3];
      const FacetId across = mesh_.beside(to, from);
      if (!across.valid()) continue;
      const double least = is_on_chain(from, to) ? sharpest : folded_back;
      if (mesh_.normal(across).normalized().dot(normal) < least) return false;
    }
    return true;
  }

  static constexpr int most_flips = 6, most_parting = 3, freely = 2;
  static constexpr double least_angle = 1;     // degrees
  static constexpr double folded_back = -0.2;  // the cosine between normals across an edge of no curve
  static constexpr double sharpest = -0.995;   // and of one

  EditedMesh mesh_;
  std::vector<ChainEdge> chains_;
};

}  // namespace

std::vector<ChainEdge> chain_edges(const FeatureSamples& features) {
  std::vector<ChainEdge> edges;
  for (const std::vector<SiteId>& chain : features.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      edges.emplace_back(std::minmax(VertexId(chain[i].value), VertexId(chain[i + 1].value)));
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::pair<TriMesh, std::size_t> recover_edges(const TriMesh& remesh, const FeatureSamples& features) {
  auto broken = broken_edges(remesh, features);
  if (broken.empty()) return {remesh, 0};
  Recovery recovery(remesh, features);
  std::size_t made = 0;
  std::size_t before = broken.size() + 1;
  for (int pass = 0; pass < passes_for_edges && before > broken.size(); ++pass) {
    before = broken.size();
    std::erase_if(broken, [&](const auto& edge) {
      return recovery.make({VertexId(edge.first.value), VertexId(edge.second.value)});
    });
    made += before - broken.size();
  }
  return {recovery.mesh(), made};
}

}  // namespace fpo
