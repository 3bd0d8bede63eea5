#include "geom/shapes/polygonise.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "geom/check.h"
#include "geom/shapes/mesh_parts.h"

namespace geom {
namespace {

using Index3 = std::array<int, 3>;

/// A corner of a cell: bit a of its number is its place along axis a.
using Corner = unsigned;

/// The corners of `set` that can be reached from `start` along edges of the cell, and across a face between
/// diagonal corners if `through_faces` and the other two corners of that face are not in the set.
unsigned component(unsigned set, Corner start, bool through_faces) {
  unsigned reached = 1u << start;
  for (unsigned grown = 0; grown != reached;) {
    grown = reached;
    for (Corner c = 0; c < 8; ++c) {
      if (!(reached >> c & 1)) continue;
      for (const unsigned axis : {1u, 2u, 4u}) {
        reached |= set & 1u << (c ^ axis);
        const unsigned diagonal = 7u ^ axis, other = axis == 1 ? 2 : 1;  // of the face across this axis
        const bool separated = !(set >> (c ^ other) & 1) && !(set >> (c ^ diagonal ^ other) & 1);
        if (through_faces && separated) reached |= set & 1u << (c ^ diagonal);
      }
    }
  }
  return reached;
}

/// Where the surface crosses the edge from the inside to the outside corner, it belongs to the loop on the
/// cell's boundary between their two components. (Regions of a sphere that touch do so along one loop.) On a
/// face whose diagonals differ, the inside corners count as separate, in both cells alike.
unsigned loop_through(unsigned inside, Corner in, Corner out) {
  return component(inside, in, false) << 8 | component(~inside & 255u, out, true);
}

/// The signs of the function at the nodes of a lattice, and the surface between them.
class DualSurface {
 public:
  DualSurface(const ImplicitSurface& surface, int cells) : origin_(surface.box.min()) {
    const Vec3 sides = surface.box.sizes();
    step_ = sides.maxCoeff() / cells;
    for (int a = 0; a < 3; ++a) cells_[a] = static_cast<int>(std::ceil(sides[a] / step_ - 1e-9));
    const std::size_t nodes = node({cells_[0], cells_[1], cells_[2]}) + 1;
    inside_.resize(nodes);
    for_each_node([&](const Index3& at) { inside_[node(at)] = surface.at(position(at)).value < 0; });
  }

  MeshArrays build() {
    for (int axis = 0; axis < 3; ++axis) {
      for_each_node([&](const Index3& at) { add_quad(axis, at); });
    }
    for (std::size_t i = 0; i < crossings_.size(); ++i)
      mesh_.vertices[VertexId(i)] /= crossings_[VertexId(i)];
    return std::move(mesh_);
  }

 private:
  std::size_t node(const Index3& at) const {
    return (static_cast<std::size_t>(at[0]) * (cells_[1] + 1) + at[1]) * (cells_[2] + 1) + at[2];
  }
  Vec3 position(const Index3& at) const { return origin_ + step_ * Vec3(at[0], at[1], at[2]); }

  template <class Visit>
  void for_each_node(const Visit& visit) const {
    for (int i = 0; i <= cells_[0]; ++i) {
      for (int j = 0; j <= cells_[1]; ++j) {
        for (int k = 0; k <= cells_[2]; ++k) visit(Index3{i, j, k});
      }
    }
  }

  /// The inside corners of a cell, which goes by its lowest node.
  unsigned inside_corners(const Index3& cell) const {
    unsigned set = 0;
    for (int c = 0; c < 8; ++c) {
      const bool in = inside_[node({cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)})];
      set |= static_cast<unsigned>(in) << c;
    }
    return set;
  }

  /// The vertex of the loop that crosses the edge between two corners of the cell at `crossing`. Sums the
  /// crossings.
  VertexId vertex(const Index3& cell, Corner in, Corner out, const Vec3& crossing) {
    const std::pair key(node(cell), loop_through(inside_corners(cell), in, out));
    const auto [entry, is_new] = vertex_of_loop_.try_emplace(key, mesh_.vertices.next_id());
    if (is_new) mesh_.add(Vec3::Zero()), crossings_.push_back(0);
    mesh_.vertices[entry->second] += crossing;
    ++crossings_[entry->second];
    return entry->second;
  }

  /// The four cells around the lattice edge from `at` along `axis`, if the surface crosses it.
  void add_quad(int axis, const Index3& at) {
    if (at[axis] == cells_[axis]) return;
    Index3 end = at;
    ++end[axis];
    const bool leaves = inside_[node(at)];
    if (leaves == inside_[node(end)]) return;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    require(at[b] > 0 && at[c] > 0 && at[b] < cells_[b] && at[c] < cells_[c],
            "the implicit surface reaches its box");
    const Vec3 crossing = (position(at) + position(end)) / 2;
    const auto vertex_of = [&](int back_b, int back_c) {
      Index3 cell = at;
      cell[b] -= back_b;
      cell[c] -= back_c;
      const Corner low = static_cast<unsigned>(back_b << b | back_c << c), high = low | 1u << axis;
      return leaves ? vertex(cell, low, high, crossing) : vertex(cell, high, low, crossing);
    };
    std::array<VertexId, 4> quad = {vertex_of(1, 1), vertex_of(0, 1), vertex_of(0, 0), vertex_of(1, 0)};
    if (!leaves) std::swap(quad[1], quad[3]);
    mesh_.add_quad(quad);
  }

  Vec3 origin_;
  double step_;
  Index3 cells_;
  std::vector<bool> inside_;
  std::map<std::pair<std::size_t, unsigned>, VertexId> vertex_of_loop_;  // cell, loop_through()
  MeshArrays mesh_;
  Table<VertexId, int> crossings_;  // of each vertex's loop
};

/// Newton's method along the gradient: x - f g / |g|^2.
Vec3 projected(const ImplicitSurface& surface, Vec3 x) {
  for (int i = 0; i < 8; ++i) {
    const auto [value, gradient] = surface.at(x);
    const double slope2 = gradient.squaredNorm();
    if (value == 0 || slope2 == 0) break;
    x -= gradient * (value / slope2);
  }
  return x;
}

/// Moves each vertex towards the mean of its neighbours along the quadrilaterals' sides (facets 2i and 2i + 1
/// are a b c and a c d), within the tangent plane, and back onto the surface.
void smooth(const ImplicitSurface& surface, MeshArrays& mesh) {
  Table<VertexId, Vec3> sum(mesh.vertices.size(), Vec3::Zero());
  Table<VertexId, int> count(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.facets.size(); ++t) {
    const TriMesh::Facet& f = mesh.facets[FacetId(t)];
    for (const std::size_t i : {t % 2, t % 2 + 1}) {
      sum[f[i]] += mesh.vertices[f[(i + 1) % 3]];
      ++count[f[i]];
    }
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const VertexId v(i);
    Vec3& x = mesh.vertices[v];
    const Vec3 normal = surface.at(x).gradient.normalized();
    const Vec3 step = sum[v] / count[v] - x;
    x = projected(surface, x + 0.7 * (step - normal * normal.dot(step)));
  }
}

/// Of the two diagonals of each quadrilateral (facets 2i and 2i + 1), the shorter one.
void choose_diagonals(MeshArrays& mesh) {
  for (std::size_t i = 0; i < mesh.facets.size(); i += 2) {
    TriMesh::Facet &first = mesh.facets[FacetId(i)], &second = mesh.facets[FacetId(i + 1)];
    const auto [a, b, c] = first;
    const VertexId d = second[2];
    const double ac = (mesh.vertices[a] - mesh.vertices[c]).squaredNorm();
    const double bd = (mesh.vertices[b] - mesh.vertices[d]).squaredNorm();
    if (bd >= ac) continue;
    first = {a, b, d};
    second = {b, c, d};
  }
}

}  // namespace

TriMesh polygonised(const ImplicitSurface& surface, int cells) {
  constexpr int rounds = 10;
  MeshArrays mesh = DualSurface(surface, cells).build();
  for (Vec3& x : mesh.vertices) x = projected(surface, x);
  for (int i = 0; i < rounds; ++i) smooth(surface, mesh);
  choose_diagonals(mesh);
  TriMesh result = mesh.take();
  require(topology(result).manifold(), "the lattice is too coarse for this implicit surface");
  return result;
}

}  // namespace geom
