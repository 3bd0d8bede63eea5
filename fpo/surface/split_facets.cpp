#include "fpo/surface/split_facets.h"

#include <algorithm>
#include <array>
#include <limits>

#include "fpo/surface/halved_edges.h"
#include "fpo/surface/needle_parts.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {
namespace {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

class Splitting {
 public:
  Splitting(const TriMesh& mesh, const Sizing& sizing, double most)
      : edges_(mesh, sizing, most), facets_(mesh.facets()), uniform_(sizing.is_uniform()) {
    for (std::size_t t = 0; t < facets_.size(); ++t) parents_.emplace_back(t);
  }

  /// Cuts needles to their end, as long as there are not more than so many parts.
  void cut_needles(std::span<SurfaceSample> samples, std::size_t most_parts) {
    const auto is_needle = [&](const TriMesh::Facet& f) { return NeedleParts::is_needle(f, edges_); };
    if (std::ranges::none_of(facets_, is_needle)) return;
    NeedleParts needle(edges_);
    replace(samples, [&](const TriMesh::Facet& facet, Table<FacetId, TriMesh::Facet>& parts) {
      if (parts.size() <= most_parts && is_needle(facet))
        needle.cut(facet, most_parts - parts.size(), parts);
      else
        parts.push_back(facet);
    });
    has_needles_ = true;
  }

  /// Halves each long edge once. False if there is none.
  bool halve(std::span<SurfaceSample> samples) {
    const std::size_t before = facets_.size();
    if (!has_needles_) edges_.forget_middles();  // else some are of needles' sides, and wait
    replace(samples,
            [&](const TriMesh::Facet& facet, Table<FacetId, TriMesh::Facet>& parts) { split(facet, parts); });
    return facets_.size() > before;
  }

  std::size_t num_parts() const { return facets_.size(); }

  SplitSurface take() {
    VertexField h;
    if (!uniform_) h = edges_.take_lengths();
    return {TriMesh(edges_.take_positions(), std::move(facets_)), std::move(h), std::move(parents_)};
  }

 private:
  /// Each facet by its parts, which cut(facet, parts) appends.
  template <class Cut>
  void replace(std::span<SurfaceSample> samples, const Cut& cut) {
    Table<FacetId, TriMesh::Facet> parts;
    Table<FacetId, FacetId> parents, first_part;
    for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1)) {
      first_part.push_back(parts.next_id());
      cut(facets_[t], parts);
      parents.resize(parts.size(), parents_[t]);
    }
    first_part.push_back(parts.next_id());
    for (SurfaceSample& x : samples)
      x.facet = nearest_of(x.position, parts, first_part[x.facet], first_part[FacetId(x.facet.value + 1)]);
    facets_ = std::move(parts);
    parents_ = std::move(parents);
  }

  void split(const TriMesh::Facet& facet, Table<FacetId, TriMesh::Facet>& parts) {
    std::array<VertexId, 3> m;
    std::size_t count = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      m[e] = edges_.middle(facet[e], facet[(e + 1) % 3]);
      count += m[e].valid();
    }
    if (count == 0) return parts.push_back(facet);
    if (count == 3) {
      for (std::size_t e = 0; e < 3; ++e) parts.push_back({facet[e], m[e], m[(e + 2) % 3]});
      return parts.push_back({m[0], m[1], m[2]});
    }
    // From edge e on: halved, and maybe the next one, not the last one.
    std::size_t e = 0;
    while (!m[e].valid() || m[(e + 2) % 3].valid()) ++e;
    const VertexId a = facet[e], b = facet[(e + 1) % 3], c = facet[(e + 2) % 3], ab = m[e],
                   bc = m[(e + 1) % 3];
    if (count == 1) {
      parts.push_back({a, ab, c});
      parts.push_back({ab, b, c});
    } else {
      parts.push_back({ab, b, bc});
      parts.push_back({a, ab, bc});
      parts.push_back({a, bc, c});
    }
  }

  FacetId nearest_of(const Vec3& x, const Table<FacetId, TriMesh::Facet>& parts, FacetId first,
                     FacetId end) const {
    FacetId best = first;
    double least = std::numeric_limits<double>::infinity();
    for (FacetId t = first; t < end && end.value - first.value > 1; t = FacetId(t.value + 1)) {
      const auto& [a, b, c] = parts[t];
      const auto& at = edges_.positions();
      const double distance2 = geom::closest_point(x, {at[a], at[b], at[c]}).distance2;
      if (distance2 < least) least = distance2, best = t;
    }
    return best;
  }

  HalvedEdges edges_;
  Table<FacetId, TriMesh::Facet> facets_;
  Table<FacetId, FacetId> parents_;
  bool uniform_, has_needles_ = false;
};

}  // namespace

bool has_long_edges(const TriMesh& mesh, const Sizing& sizing, double most) {
  return std::ranges::any_of(mesh.facets(), [&](const TriMesh::Facet& f) {
    for (std::size_t e = 0; e < 3; ++e) {
      const VertexId a = f[e], b = f[(e + 1) % 3];
      const double length = (mesh.position(a) - mesh.position(b)).norm();
      if (length > most * std::min(sizing.at(a), sizing.at(b))) return true;
    }
    return false;
  });
}

SplitSurface split_long_edges(const TriMesh& mesh, const Sizing& sizing, double most,
                              std::span<SurfaceSample> samples, std::size_t most_parts) {
  Splitting splitting(mesh, sizing, most);
  splitting.cut_needles(samples, most_parts);
  while (splitting.num_parts() <= most_parts && splitting.halve(samples)) continue;
  return splitting.take();
}

}  // namespace fpo
