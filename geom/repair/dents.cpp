#include "geom/repair/dents.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "geom/mesh/angles.h"
#include "geom/mesh/half_edges.h"
#include "geom/repair/border_loops.h"
#include "geom/repair/fill_polygon.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

constexpr double deep = 0.75;  ///< of the way along the border is the width, at most
constexpr double straight = 40 * std::numbers::pi / 180;
constexpr double most_share = 0.02;  ///< of the area, all dents

/// The borders of a mesh and what lies at them.
class Dents {
 public:
  Dents(const Table<VertexId, Vec3>& vertices, const Facets& facets)
      : vertices_(vertices), facets_(facets), half_edges_(sorted_half_edges(facets)) {
    for_each_edge(half_edges_, [&](auto first, auto last) {
      if (last - first == 1) leaving_[first->from()] = &*first;
      if (last - first == 1) angle_[first->from()] = angle_[first->to()] = 0;
    });
    for (const TriMesh::Facet& f : facets) {
      area_ += normal(f).norm() / 2;
      for (std::size_t i = 0; i < 3; ++i)
        if (const auto known = angle_.find(f[i]); known != angle_.end())
          known->second += angle_at(vertices[f[i]], vertices[f[(i + 1) % 3]], vertices[f[(i + 2) % 3]]);
    }
  }

  std::size_t run(const DentLimits& limits) {
    std::size_t count = 0;
    for (const BorderLoop& loop : border_loops(vertices_, facets_))
      if (loop.simple) count += look_along(loop.vertices, limits);
    return filled_area_ <= most_share * area_ ? count : 0;
  }

  std::vector<TriMesh::Facet> fillings;

 private:
  using Loop = std::vector<VertexId>;

  Vec3 normal(const TriMesh::Facet& f) const {
    return (vertices_[f[1]] - vertices_[f[0]]).cross(vertices_[f[2]] - vertices_[f[0]]);
  }
  const Vec3& place(const Loop& loop, std::size_t i) const { return vertices_[loop[i % loop.size()]]; }

  /// The shortest first, so that none is taken for a part of one that is less deep.
  std::size_t look_along(const Loop& loop, const DentLimits& limits) {
    std::vector<char> taken(loop.size(), 0);
    std::size_t count = 0;
    for (std::size_t sides = 2; sides <= limits.facets + 1 && sides + 2 < loop.size(); ++sides)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        bool free = true;
        for (std::size_t j = 0; j < sides; ++j) free = free && !taken[(i + j) % loop.size()];
        if (!free || !is_dent(loop, i, sides) || !fill(loop, i, sides, limits)) continue;
        for (std::size_t j = 0; j < sides; ++j) taken[(i + j) % loop.size()] = 1;
        ++count;
      }
    return count;
  }

  bool is_dent(const Loop& loop, std::size_t first, std::size_t sides) const {
    const std::size_t last = first + sides, m = loop.size();
    const Vec3 across = place(loop, last) - place(loop, first);
    double way = 0, bent = 0;
    for (std::size_t i = first; i < last; ++i) {
      way += (place(loop, i + 1) - place(loop, i)).norm();
      if (i > first) bent += angle_.at(loop[i % m]) - std::numbers::pi;
    }
    return across.norm() <= deep * way && bent > straight &&
           angle_between(place(loop, first) - place(loop, first + m - 1), across) < straight &&
           angle_between(across, place(loop, last + 1) - place(loop, last)) < straight;
  }

  /// If it is small enough and can be filled.
  bool fill(const Loop& loop, std::size_t first, std::size_t sides, const DentLimits& limits) {
    Loop rim;
    std::vector<Vec3> corners, across;
    for (std::size_t i = first + sides + 1; i-- > first;) rim.push_back(loop[i % loop.size()]);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      corners.push_back(vertices_[rim[i]]);
      Vec3 beside(0, 0, 0);
      if (i + 1 < rim.size()) {
        const auto edge = leaving_.find(rim[i + 1]);
        if (edge == leaving_.end() || edge->second->to() != rim[i]) return false;
        beside = normal(facets_[edge->second->facet]).normalized();
      }
      across.push_back(beside);
    }
    const auto forbidden = [&](std::size_t i, std::size_t j) {
      return num_facets_at(half_edges_, rim[i], rim[j]) > 0;
    };
    if (forbidden(0, rim.size() - 1)) return false;
    std::vector<TriMesh::Facet> triangles;
    double area = 0;
    for (const auto& [i, j, k] : filled({corners, across, forbidden})) {
      triangles.push_back({rim[i], rim[j], rim[k]});
      area += normal(triangles.back()).norm() / 2;
    }
    if (triangles.empty() || area > limits.area * area_) return false;
    filled_area_ += area;
    fillings.insert(fillings.end(), triangles.begin(), triangles.end());
    return true;
  }

  const Table<VertexId, Vec3>& vertices_;
  const Facets& facets_;
  std::vector<HalfEdge> half_edges_;
  std::map<VertexId, const HalfEdge*> leaving_;  ///< the border edge, the last one if there are several
  std::map<VertexId, double> angle_;             ///< of the facets around a border vertex
  double area_ = 0, filled_area_ = 0;
};

}  // namespace

std::size_t fill_dents(const Table<VertexId, Vec3>& vertices, Facets& facets, const DentLimits& limits) {
  Dents dents(vertices, facets);
  const std::size_t count = dents.run(limits);
  if (count > 0)
    for (const TriMesh::Facet& f : dents.fillings) facets.push_back(f);
  return count;
}

}  // namespace geom
