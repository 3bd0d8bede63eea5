#include "fpo/surface/split_facets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"

namespace fpo {
namespace {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

bool is_long(const Vec3& a, const Vec3& b, double least_h, double most) {
  return (a - b).norm() > most * least_h;
}

class Splitting {
 public:
  Splitting(const TriMesh& mesh, const Sizing& sizing, double most)
      : positions_(mesh.vertices()), facets_(mesh.facets()), most_(most), uniform_(sizing.is_uniform()) {
    for (VertexId v(0); v.index() < positions_.size(); v = VertexId(v.value + 1)) h_.push_back(sizing.at(v));
    for (std::size_t t = 0; t < facets_.size(); ++t) parents_.emplace_back(t);
  }

  /// Halves each long edge once. False if there is none.
  bool halve(std::span<SurfaceSample> samples) {
    middles_.clear();
    Table<FacetId, TriMesh::Facet> parts;
    Table<FacetId, FacetId> parents, first_part;
    for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1)) {
      first_part.push_back(parts.next_id());
      split(facets_[t], parts);
      parents.resize(parts.size(), parents_[t]);
    }
    first_part.push_back(parts.next_id());
    for (SurfaceSample& x : samples)
      x.facet = nearest_of(x.position, parts, first_part[x.facet], first_part[FacetId(x.facet.value + 1)]);
    facets_ = std::move(parts);
    parents_ = std::move(parents);
    return !middles_.empty();
  }

  std::size_t num_parts() const { return facets_.size(); }

  SplitSurface take() {
    if (uniform_) h_.clear();
    return {TriMesh(std::move(positions_), std::move(facets_)), std::move(h_), std::move(parents_)};
  }

 private:
  /// The middle of an edge if that is long, else none.
  VertexId middle(VertexId a, VertexId b) {
    if (!is_long(positions_[a], positions_[b], std::min(h_[a], h_[b]), most_)) return {};
    const auto [low, high] = std::minmax(a, b);
    const auto key = static_cast<std::uint64_t>(low.value) << 32 | static_cast<std::uint64_t>(high.value);
    const auto [at, is_new] = middles_.try_emplace(key, positions_.next_id());
    if (is_new) {
      const Vec3 &p = positions_[low], &q = positions_[high];
      positions_.push_back(geom::snapped(Vec3(0.5 * p + 0.5 * q)));
      h_.push_back(0.5 * h_[low] + 0.5 * h_[high]);
    }
    return at->second;
  }

  void split(const TriMesh::Facet& facet, Table<FacetId, TriMesh::Facet>& parts) {
    std::array<VertexId, 3> m;
    std::size_t count = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      m[e] = middle(facet[e], facet[(e + 1) % 3]);
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
      const double distance2 =
          geom::closest_point(x, {positions_[a], positions_[b], positions_[c]}).distance2;
      if (distance2 < least) least = distance2, best = t;
    }
    return best;
  }

  Table<VertexId, Vec3> positions_;
  Table<FacetId, TriMesh::Facet> facets_;
  Table<FacetId, FacetId> parents_;
  VertexField h_;
  double most_;
  bool uniform_;
  std::unordered_map<std::uint64_t, VertexId> middles_;  ///< by the ends of the edge
};

}  // namespace

bool has_long_edges(const TriMesh& mesh, const Sizing& sizing, double most) {
  return std::ranges::any_of(mesh.facets(), [&](const TriMesh::Facet& f) {
    for (std::size_t e = 0; e < 3; ++e) {
      const VertexId a = f[e], b = f[(e + 1) % 3];
      if (is_long(mesh.position(a), mesh.position(b), std::min(sizing.at(a), sizing.at(b)), most))
        return true;
    }
    return false;
  });
}

SplitSurface split_long_edges(const TriMesh& mesh, const Sizing& sizing, double most,
                              std::span<SurfaceSample> samples, std::size_t most_parts) {
  Splitting splitting(mesh, sizing, most);
  while (splitting.num_parts() <= most_parts && splitting.halve(samples)) continue;
  return splitting.take();
}

}  // namespace fpo
