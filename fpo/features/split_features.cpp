#include "fpo/features/split_features.h"

#include <algorithm>
#include <map>

#include "geom/check.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

/// An edge of a part, with the part.
struct SideEdge {
  VertexId to;
  FacetId part;
};

/// The sides of facets, each as edges of the facet's parts.
class SplitSides {
 public:
  SplitSides(const TriMesh& mesh, const SplitSurface& split, const Features& features)
      : mesh_(mesh), next_(mesh.num_facets()) {
    std::vector<char> is_at_curve(mesh.num_facets(), 0);
    for (const FeatureCurve& curve : features.curves)
      for (const FacetId t : curve.facets) is_at_curve[t.index()] = 1;
    for (FacetId part(0); part.index() < split.mesh.num_facets(); part = FacetId(part.value + 1)) {
      const FacetId parent = split.parents[part];
      for (std::size_t e = 0; e < 3 && is_at_curve[parent.index()] != 0; ++e) {
        const FacetId other = split.mesh.across(part, static_cast<int>(e));
        if (other.valid() && split.parents[other] == parent) continue;
        const TriMesh::Facet& f = split.mesh.facet(part);
        next_[parent.index()][f[e]] = {f[(e + 1) % 3], part};
      }
    }
  }

  struct Chain {
    std::vector<VertexId> vertices;  ///< from one end up to, without, the other
    std::vector<FacetId> parts;      ///< at the edge that begins at each
  };
  /// Of the side of t from a to b, or from b to a.
  Chain chain(FacetId t, VertexId a, VertexId b) const {
    const TriMesh::Facet& f = mesh_.facet(t);
    const auto at = static_cast<std::size_t>(std::ranges::find(f, a) - f.begin());
    geom::ensure(at < 3, "features: a curve has a facet that is not at its edge");
    if (f[(at + 1) % 3] == b) return along(t, a, b);
    Chain back = along(t, b, a);
    back.vertices.push_back(a);
    std::ranges::reverse(back.vertices);
    back.vertices.pop_back();
    std::ranges::reverse(back.parts);
    return back;
  }

 private:
  Chain along(FacetId t, VertexId from, VertexId to) const {
    Chain chain;
    const auto& next = next_[t.index()];
    for (VertexId v = from; v != to;) {
      const auto edge = next.find(v);
      geom::ensure(edge != next.end() && chain.vertices.size() <= next.size(),
                   "features: the parts of a facet have no side from corner to corner");
      chain.vertices.push_back(v);
      chain.parts.push_back(edge->second.part);
      v = edge->second.to;
    }
    return chain;
  }

  const TriMesh& mesh_;
  std::vector<std::map<VertexId, SideEdge>> next_;  ///< around each facet at a curve
};

}  // namespace

Features split_features(const Features& features, const TriMesh& mesh, const SplitSurface& split) {
  const SplitSides sides(mesh, split, features);
  Features result{features.corners, {}};
  for (const FeatureCurve& curve : features.curves) {
    FeatureCurve& now = result.curves.emplace_back();
    now.loop = curve.loop;
    now.sheets = curve.sheets;
    for (std::size_t i = 0; i < curve.facets.size(); ++i) {
      const VertexId a = curve.vertices[i], b = curve.vertices[(i + 1) % curve.vertices.size()];
      const SplitSides::Chain chain = sides.chain(curve.facets[i], a, b);
      now.vertices.insert(now.vertices.end(), chain.vertices.begin(), chain.vertices.end());
      now.facets.insert(now.facets.end(), chain.parts.begin(), chain.parts.end());
    }
    if (!curve.loop) now.vertices.push_back(curve.vertices.back());
  }
  return result;
}

}  // namespace fpo
