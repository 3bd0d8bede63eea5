#include "fpo/plane/rectangle.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"

namespace fpo {

using geom::Vec2;
using geom::Vec3;
using geom::VertexId;

geom::TriMesh rectangle_mesh(const Vec2& size, int cells) {
  geom::require(size.minCoeff() > 0 && size.allFinite(), "the sides of a rectangle must be positive");
  geom::require(cells >= 1 && cells <= 2048, "a rectangle has 1 to 2048 cells along its longer side");
  const auto cells_along = [&](double side) {
    return static_cast<int>(std::max(1.0, std::round(cells * side / size.maxCoeff())));
  };
  const int columns = cells_along(size.x()), rows = cells_along(size.y());
  geom::Table<VertexId, Vec3> vertices;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i)
      vertices.push_back(
          {i == columns ? size.x() : size.x() * i / columns, j == rows ? size.y() : size.y() * j / rows, 0});
  }
  geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
  const auto vertex = [&](int i, int j) {
    return VertexId(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1) +
                    static_cast<std::size_t>(i));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const VertexId a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      facets.push_back({a, b, c});
      facets.push_back({a, c, d});
    }
  }
  return geom::TriMesh(std::move(vertices), std::move(facets));
}

VertexField rho_at_vertices(const geom::TriMesh& rectangle, const PlaneSizing& sizing) {
  VertexField rho;
  for (const Vec3& x : rectangle.vertices()) rho.push_back(sizing.rho(x.head<2>()));
  return rho;
}

}  // namespace fpo
