#pragma once
// Meshes to write and read, and ways to compare them.

#include <array>
#include <cmath>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>

#include "geom/check.h"
#include "geom/mesh/trimesh.h"

namespace fixtures {

using Facet = std::array<int, 3>;

inline geom::TriMesh make_mesh(const std::vector<geom::Vec3>& points, const std::vector<Facet>& facets) {
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  geom::Table<geom::FacetId, geom::TriMesh::Facet> triangles;
  for (const geom::Vec3& p : points) vertices.push_back(p);
  for (const auto& [a, b, c] : facets)
    triangles.push_back({geom::VertexId(a), geom::VertexId(b), geom::VertexId(c)});
  return {std::move(vertices), std::move(triangles)};
}

inline geom::TriMesh tetrahedron() {
  return make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

/// Facets that use every vertex once or twice; coordinates of all magnitudes and no short decimals. With
/// `single_precision` they are floats.
inline geom::TriMesh random_soup(unsigned seed, bool single_precision) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-20, 20);
  const auto coordinate = [&] {
    const double x = std::ldexp(mantissa(random), exponent(random));
    return single_precision ? static_cast<double>(static_cast<float>(x)) : x;
  };
  std::vector<geom::Vec3> points;
  std::vector<Facet> facets;
  for (int i = 0; i < 200; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.emplace_back(x, y, z);
    if (i >= 2) facets.push_back({i - 2, i, i - 1});
  }
  return make_mesh(points, facets);
}

inline bool identical(const geom::TriMesh& a, const geom::TriMesh& b) {
  return a.vertices() == b.vertices() && a.facets() == b.facets();
}

/// The same facets by position, in the same order: what a format without vertex ids can keep.
inline bool same_soup(const geom::TriMesh& a, const geom::TriMesh& b) {
  if (a.num_facets() != b.num_facets()) return false;
  for (std::size_t t = 0; t < a.num_facets(); ++t)
    for (int k = 0; k < 3; ++k)
      if (a.corner(geom::FacetId(t), k) != b.corner(geom::FacetId(t), k)) return false;
  return true;
}

/// The corners of all facets, "0 1 2, 0 2 3".
inline std::string corners(const geom::TriMesh& mesh) {
  std::string text;
  for (const auto& facet : mesh.facets()) {
    if (!text.empty()) text += ", ";
    for (const geom::VertexId v : facet) text += (v == facet[0] ? "" : " ") + std::to_string(v.value);
  }
  return text;
}

/// The message of the InputError that `run` throws; "" if it throws none. Other exceptions pass.
template <class Run>
std::string complaint(Run run) {
  try {
    run();
  } catch (const geom::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace fixtures
