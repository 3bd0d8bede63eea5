#include "geom/shapes/mesh_parts.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace geom {

VertexId MeshArrays::add(const Vec3& position) {
  vertices.push_back(position);
  return VertexId(vertices.size() - 1);
}

void MeshArrays::add_quad(const std::array<VertexId, 4>& corners) {
  add_triangle(corners[0], corners[1], corners[2]);
  add_triangle(corners[0], corners[2], corners[3]);
}

TriMesh grid_surface(GridAxis u, GridAxis v, const std::function<Vec3(double, double)>& f) {
  MeshArrays mesh;
  const int columns = u.steps + (u.seam == Seam::open), rows = v.steps + (v.seam == Seam::open);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) mesh.add(f(double(i) / u.steps, double(j) / v.steps));
  }
  const auto at = [&](int i, int j) {
    if (i == columns) {
      i = 0;
      if (u.seam == Seam::reversed) j = v.steps - j;
    }
    return VertexId(static_cast<std::size_t>(i) * rows + j % rows);
  };
  for (int i = 0; i < u.steps; ++i) {
    for (int j = 0; j < v.steps; ++j) mesh.add_quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  return mesh.take();
}

TriMesh revolved(const std::vector<Vec2>& profile, bool closed, int segments) {
  MeshArrays mesh;
  std::vector<std::vector<VertexId>> rings;  // one vertex on the axis, else one a segment
  for (const Vec2& p : profile) {
    std::vector<VertexId>& ring = rings.emplace_back();
    const int count = p.x() == 0 ? 1 : segments;
    for (int s = 0; s < count; ++s) {
      const double angle = 2 * std::numbers::pi * s / segments;
      ring.push_back(mesh.add({p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()}));
    }
  }
  const std::size_t sides = rings.size() - !closed;
  for (std::size_t i = 0; i < sides; ++i) {
    const std::vector<VertexId>&from = rings[i], &to = rings[(i + 1) % rings.size()];
    for (std::size_t s = 0; s < static_cast<std::size_t>(segments); ++s) {
      const VertexId a = from[s % from.size()], b = from[(s + 1) % from.size()];
      const VertexId c = to[(s + 1) % to.size()], d = to[s % to.size()];
      if (a != b) mesh.add_triangle(a, b, c);
      if (c != d) mesh.add_triangle(a, c, d);
    }
  }
  return mesh.take();
}

std::vector<Vec2> refined(const std::vector<Vec2>& polygon, bool closed, double step) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    points.push_back(a);
    if (i + 1 == polygon.size() && !closed) break;
    const int parts = static_cast<int>(std::ceil((b - a).norm() / step));
    for (int k = 1; k < parts; ++k) points.push_back(a + (b - a) * (double(k) / parts));
  }
  return points;
}

namespace {

using Lattice = std::array<int, 3>;

/// The walk over the walls between solid and empty blocks.
class BlockSkin {
 public:
  explicit BlockSkin(const Blocks& blocks) : blocks_(blocks) {}

  TriMesh build() {
    for (int axis = 0; axis < 3; ++axis) {
      const auto [b, c] = others(axis);
      Lattice block{};
      for (block[axis] = 0; block[axis] <= count(axis); ++block[axis]) {
        for (block[b] = 0; block[b] < count(b); ++block[b]) {
          for (block[c] = 0; block[c] < count(c); ++block[c]) add_wall(axis, block);
        }
      }
    }
    return mesh_.take();
  }

 private:
  /// The two axes that with `axis` make a right-handed frame.
  static std::pair<int, int> others(int axis) { return {(axis + 1) % 3, (axis + 2) % 3}; }
  int count(int axis) const { return static_cast<int>(blocks_.planes[axis].size()) - 1; }

  bool is_solid(const Lattice& block) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (block[axis] < 0 || block[axis] >= count(axis)) return false;
    }
    return blocks_.is_solid(block[0], block[1], block[2]);
  }

  /// The wall between `block` and the one before it along the axis, if just one of the two is solid.
  void add_wall(int axis, const Lattice& block) {
    Lattice before = block;
    --before[axis];
    const bool faces_up = is_solid(before);
    if (faces_up == is_solid(block)) return;
    const auto [b, c] = others(axis);
    Lattice base;
    for (int k = 0; k < 3; ++k) base[k] = block[k] * blocks_.pieces[k];
    for (int i = 0; i < blocks_.pieces[b]; ++i) {
      for (int j = 0; j < blocks_.pieces[c]; ++j) {
        const auto corner = [&, b = b, c = c](int di, int dj) {
          Lattice at = base;
          at[b] += i + di;
          at[c] += j + dj;
          return vertex(at);
        };
        std::array<VertexId, 4> quad = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        if (!faces_up) std::swap(quad[1], quad[3]);
        mesh_.add_quad(quad);
      }
    }
  }

  VertexId vertex(const Lattice& at) {
    const auto [entry, is_new] = ids_.try_emplace(at);
    if (is_new) entry->second = mesh_.add({coordinate(0, at[0]), coordinate(1, at[1]), coordinate(2, at[2])});
    return entry->second;
  }

  double coordinate(int axis, int at) const {
    const int pieces = blocks_.pieces[axis];
    const std::vector<double>& planes = blocks_.planes[axis];
    const auto i = static_cast<std::size_t>(at / pieces);
    if (at % pieces == 0) return planes[i];
    return planes[i] + (planes[i + 1] - planes[i]) * (double(at % pieces) / pieces);
  }

  const Blocks& blocks_;
  MeshArrays mesh_;
  std::map<Lattice, VertexId> ids_;
};

}  // namespace

TriMesh block_surface(const Blocks& blocks) { return BlockSkin(blocks).build(); }

TriMesh subdivided(const TriMesh& mesh, int k) {
  MeshArrays fine;
  fine.vertices = mesh.vertices();
  std::map<std::pair<VertexId, VertexId>, std::size_t>
      first_on_edge;  // edge from the smaller id: k - 1 vertices

  // The vertex i steps of k along the edge from a to b.
  const auto on_edge = [&](VertexId a, VertexId b, int i) {
    if (b < a) std::swap(a, b), i = k - i;
    const auto [entry, is_new] = first_on_edge.try_emplace({a, b}, fine.vertices.size());
    if (is_new) {
      const Vec3& from = mesh.position(a);
      const Vec3 span = mesh.position(b) - from;
      for (int s = 1; s < k; ++s) fine.add(from + span * (double(s) / k));
    }
    return VertexId(entry->second + static_cast<std::size_t>(i - 1));
  };

  for (const TriMesh::Facet& f : mesh.facets()) {
    const Vec3& q0 = mesh.position(f[0]);
    const Vec3 e1 = mesh.position(f[1]) - q0, e2 = mesh.position(f[2]) - q0;
    // Row i holds the vertices q0 + (i - j)/k e1 + j/k e2, j = 0..i.
    std::vector<std::vector<VertexId>> rows(static_cast<std::size_t>(k) + 1);
    for (int i = 0; i <= k; ++i) {
      for (int j = 0; j <= i; ++j) {
        VertexId v;
        if (i == 0)
          v = f[0];
        else if (i == k && j == 0)
          v = f[1];
        else if (i == k && j == k)
          v = f[2];
        else if (j == 0)
          v = on_edge(f[0], f[1], i);
        else if (j == i)
          v = on_edge(f[0], f[2], i);
        else if (i == k)
          v = on_edge(f[1], f[2], j);
        else
          v = fine.add(q0 + e1 * (double(i - j) / k) + e2 * (double(j) / k));
        rows[static_cast<std::size_t>(i)].push_back(v);
      }
    }
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        fine.add_triangle(rows[i][j], rows[i + 1][j], rows[i + 1][j + 1]);
        if (j < i) fine.add_triangle(rows[i][j], rows[i + 1][j + 1], rows[i][j + 1]);
      }
    }
  }
  return fine.take();
}

TriMesh mapped(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& f) {
  Table<VertexId, Vec3> vertices = mesh.vertices();
  for (Vec3& p : vertices) p = f(p);
  return {std::move(vertices), mesh.facets()};
}

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  MeshArrays both{a.vertices(), a.facets()};
  const auto shift = static_cast<std::int32_t>(a.num_vertices());
  for (const Vec3& p : b.vertices()) both.vertices.push_back(p);
  for (const TriMesh::Facet& f : b.facets()) {
    both.add_triangle(VertexId(f[0].value + shift), VertexId(f[1].value + shift),
                      VertexId(f[2].value + shift));
  }
  return both.take();
}

}  // namespace geom
