#include "geom/repair/patch.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <map>
#include <set>

#include "geom/mesh/angles.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

constexpr int most_relaxations = 40;
constexpr std::size_t most_new_vertices = 50'000;
constexpr double density = 1.4142135623730951;  // Liepa's factor

/// A patch under refinement.
class Patch {
 public:
  Patch(Table<VertexId, Vec3>& vertices, Facets& facets, FacetId first, std::span<const FacetId> beside)
      : vertices_(vertices), facets_(facets), first_(first), first_new_(vertices.size()) {
    measure_rim(beside);
  }

  std::size_t run() {
    for (int round = 0; round < most_relaxations; ++round) {
      if (!cut_large()) break;
      for (int pass = 0; pass < most_relaxations && flip_edges(); ++pass) {
      }
    }
    const std::size_t added = vertices_.size() - first_new_.index();
    if (added > 0) fair();
    return added;
  }

 private:
  bool is_new(VertexId v) const { return v >= first_new_; }

  /// The wanted length at each vertex of the patch: the mean of the edges there that are not of the patch.
  void measure_rim(std::span<const FacetId> beside) {
    std::set<VertexId> rim;
    for (FacetId t = first_; t.index() < facets_.size(); t = FacetId(t.value + 1))
      rim.insert(facets_[t].begin(), facets_[t].end());
    std::map<VertexId, double> counts;
    std::set<std::pair<VertexId, VertexId>> seen;
    for (const FacetId t : beside) {
      for (std::size_t e = 0; e < 3; ++e) {
        const VertexId a = facets_[t][e], b = facets_[t][(e + 1) % 3];
        if ((!rim.contains(a) && !rim.contains(b)) || !seen.insert(std::minmax(a, b)).second) continue;
        around_[a].insert(b), around_[b].insert(a);
        for (const VertexId v : {a, b})
          if (rim.contains(v)) size_[v] += (vertices_[a] - vertices_[b]).norm(), counts[v] += 1;
      }
    }
    for (auto& [v, size] : size_) size /= counts[v];
  }

  /// Whether any facet was cut at its middle.
  bool cut_large() {
    const std::size_t before = facets_.size();
    for (FacetId t = first_; t.index() < before; t = FacetId(t.value + 1)) {
      if (vertices_.size() - first_new_.index() >= most_new_vertices) break;
      const auto [a, b, c] = facets_[t];
      const Vec3 middle = (vertices_[a] + vertices_[b] + vertices_[c]) / 3;
      const double size = (size_[a] + size_[b] + size_[c]) / 3;
      const auto far = [&](VertexId v) {
        const double distance = density * (vertices_[v] - middle).norm();
        return distance > size && distance > size_[v];
      };
      if (!far(a) || !far(b) || !far(c)) continue;
      const VertexId m(vertices_.size());
      vertices_.push_back(middle);
      size_[m] = size;
      facets_[t] = {a, b, m};
      facets_.push_back({b, c, m});
      facets_.push_back({c, a, m});
    }
    return facets_.size() > before;
  }

  double angle(VertexId at, VertexId a, VertexId b) const {
    return angle_at(vertices_[at], vertices_[a], vertices_[b]);
  }

  /// Flips inner edges of the patch whose opposite angles sum to more than a half turn; each facet once.
  bool flip_edges() {
    Facets patch;
    for (FacetId t = first_; t.index() < facets_.size(); t = FacetId(t.value + 1))
      patch.push_back(facets_[t]);
    const std::vector<HalfEdge> half_edges = sorted_half_edges(patch);
    std::vector<char> touched(patch.size(), 0);
    std::set<std::pair<VertexId, VertexId>> joined;
    bool any = false;
    for_each_edge(half_edges, [&](auto first, auto last) {
      if (last - first != 2 || first[0].ascending == first[1].ascending) return;
      const FacetId s = first[0].facet, t = first[1].facet;
      if (touched[s.index()] || touched[t.index()]) return;
      const VertexId a = first[0].from(), b = first[0].to();
      const VertexId c = patch[s][static_cast<std::size_t>((first[0].edge + 2) % 3)],
                     d = patch[t][static_cast<std::size_t>((first[1].edge + 2) % 3)];
      constexpr double half_turn = 3.14159265358979 + 1e-6;
      if (c == d || angle(c, a, b) + angle(d, a, b) <= half_turn) return;
      if (num_facets_at(half_edges, c, d) > 0 || joined.contains(std::minmax(c, d))) return;
      if (const auto at = around_.find(c); at != around_.end() && at->second.contains(d)) return;
      joined.insert(std::minmax(c, d));
      touched[s.index()] = touched[t.index()] = 1;
      facets_[FacetId(first_.index() + s.index())] = {c, a, d};
      facets_[FacetId(first_.index() + t.index())] = {d, b, c};
      any = true;
    });
    return any;
  }

  /// Least squares of the differences between vertices and the means of their neighbours, at new vertices and
  /// the rim.
  void fair() {
    std::map<VertexId, std::set<VertexId>> around = around_;
    for (FacetId t = first_; t.index() < facets_.size(); t = FacetId(t.value + 1))
      for (std::size_t e = 0; e < 3; ++e) {
        const VertexId a = facets_[t][e], b = facets_[t][(e + 1) % 3];
        around[a].insert(b), around[b].insert(a);
      }
    const auto added = static_cast<Eigen::Index>(vertices_.size() - first_new_.index());
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Vec3> right;
    const auto add = [&](Eigen::Index row, VertexId v, double weight) {
      if (is_new(v))
        entries.emplace_back(row, v.value - first_new_.value, weight);
      else
        right.back() -= weight * vertices_[v];
    };
    for (const auto& [v, size] : size_) {
      const auto row = static_cast<Eigen::Index>(right.size());
      right.push_back(Vec3(0, 0, 0));
      add(row, v, 1);
      for (const VertexId u : around[v]) add(row, u, -1.0 / static_cast<double>(around[v].size()));
    }
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(right.size()), added);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::MatrixX3d rhs(static_cast<Eigen::Index>(right.size()), 3);
    for (std::size_t i = 0; i < right.size(); ++i) rhs.row(static_cast<Eigen::Index>(i)) = right[i];
    const Eigen::SparseMatrix<double> normal = matrix.transpose() * matrix;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
    if (solver.info() != Eigen::Success) return;
    const Eigen::MatrixX3d moved = solver.solve(matrix.transpose() * rhs);
    if (!moved.allFinite()) return;
    for (Eigen::Index i = 0; i < added; ++i)
      vertices_[VertexId(first_new_.index() + static_cast<std::size_t>(i))] = moved.row(i);
  }

  Table<VertexId, Vec3>& vertices_;
  Facets& facets_;
  FacetId first_;
  VertexId first_new_;
  std::map<VertexId, double> size_;                ///< wanted lengths, of all vertices of the patch
  std::map<VertexId, std::set<VertexId>> around_;  ///< neighbours in the rest of the mesh
};

}  // namespace

std::size_t refine_patch(Table<VertexId, Vec3>& vertices, Facets& facets, FacetId first,
                         std::span<const FacetId> beside) {
  return Patch(vertices, facets, first, beside).run();
}

}  // namespace geom
