#include "geom/shapes/layers.h"

#include <algorithm>

#include "geom/shapes/mesh_parts.h"

namespace geom {

std::size_t PlanarCells::add(const Vec2& p) {
  const auto [entry, is_new] = at_.try_emplace({p.x(), p.y()}, points_.size());
  if (is_new) points_.push_back(p);
  return entry->second;
}

std::size_t PlanarCells::add_triangle(const Vec2& a, const Vec2& b, const Vec2& c) {
  const std::size_t i = add(a), j = add(b), k = add(c);
  cells_.push_back({i, j, k});
  return cells_.size() - 1;
}

void PlanarCells::add_quad(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  add_triangle(a, b, c);
  add_triangle(a, c, d);
}

void PlanarCells::add_ring(const std::vector<Vec2>& outer, const std::vector<Vec2>& inner) {
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const std::size_t j = (i + 1) % outer.size();
    add_quad(outer[i], outer[j], inner[j], inner[i]);
  }
}

void PlanarCells::add_fan(const Vec2& middle, const std::vector<Vec2>& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    add_triangle(middle, polygon[i], polygon[(i + 1) % polygon.size()]);
}

namespace {

/// The walk over the walls between solid and empty.
class LayeredSkin {
 public:
  explicit LayeredSkin(const Layers& layers) : layers_(layers) {}

  TriMesh build() {
    for (std::size_t level = 0; level < layers_.heights.size(); ++level) add_lids(level);
    for (std::size_t slab = 0; slab < num_slabs(); ++slab) add_walls(slab);
    return mesh_.take();
  }

 private:
  std::size_t num_slabs() const { return layers_.heights.size() - 1; }
  bool is_solid(std::size_t cell, std::size_t slab) const {
    return slab < num_slabs() && layers_.is_solid(cell, slab);
  }

  VertexId vertex(std::size_t point, std::size_t level) {
    const auto [entry, is_new] = ids_.try_emplace({point, level});
    const Vec2& p = layers_.plan.points()[point];
    if (is_new) entry->second = mesh_.add({p.x(), p.y(), layers_.heights[level]});
    return entry->second;
  }

  void add_lids(std::size_t level) {
    for (std::size_t c = 0; c < layers_.plan.cells().size(); ++c) {
      const bool below = level > 0 && is_solid(c, level - 1);
      if (below == is_solid(c, level)) continue;
      const auto& [i, j, k] = layers_.plan.cells()[c];
      mesh_.add_triangle(vertex(i, level), vertex(below ? j : k, level), vertex(below ? k : j, level));
    }
  }

  /// Along the edges of solid cells across which there is none.
  void add_walls(std::size_t slab) {
    std::map<std::pair<std::size_t, std::size_t>, int> sides;
    for (std::size_t c = 0; c < layers_.plan.cells().size(); ++c)
      for (std::size_t e = 0; e < 3 && is_solid(c, slab); ++e) {
        const std::size_t a = layers_.plan.cells()[c][e], b = layers_.plan.cells()[c][(e + 1) % 3];
        ++sides[{a, b}], --sides[{b, a}];
      }
    for (const auto& [side, count] : sides) {
      const auto [a, b] = side;
      if (count > 0)
        mesh_.add_quad({vertex(a, slab), vertex(b, slab), vertex(b, slab + 1), vertex(a, slab + 1)});
    }
  }

  const Layers& layers_;
  MeshArrays mesh_;
  std::map<std::pair<std::size_t, std::size_t>, VertexId> ids_;
};

}  // namespace

TriMesh layered_surface(const Layers& layers) { return LayeredSkin(layers).build(); }

TriMesh prism(const PlanarCells& plan, double height) {
  return layered_surface({plan, {0, height}, [](std::size_t, std::size_t) { return true; }});
}

}  // namespace geom
