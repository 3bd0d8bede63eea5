#include "io/mesh_builder.h"

#include <algorithm>
#include <string>
#include <utility>

#include "geom/check.h"
#include "io/numbers.h"
#include "io/polygon.h"

namespace io {

using geom::VertexId;

namespace {

constexpr std::size_t most_elements = std::size_t{1} << 30;  // TriMesh takes no more

}  // namespace

VertexId MeshBuilder::add_vertex(const geom::Vec3& position, std::size_t place) {
  for (const double x : position)
    if (const char* fault = coordinate_fault(x)) fail(place, fault);
  if (vertices_.size() >= most_elements) fail(place, "more than 2^30 vertices");
  vertices_.push_back(position);
  return VertexId(vertices_.size() - 1);
}

void MeshBuilder::add_facet(std::span<const std::int64_t> corners, std::size_t place) {
  if (corners.size() < 3) return;
  if (polygons_.size() >= most_elements) fail(place, "more than 2^30 facets");
  polygons_.push_back({corners_.size(), place});
  for (const std::int64_t index : corners) {
    if (index < 0) fail_index(index, place, "the first vertex is " + std::to_string(first_index_));
    if (index >= static_cast<std::int64_t>(most_elements)) fail_index(index, place, "more than 2^30");
    corners_.push_back(VertexId(static_cast<std::size_t>(index)));
  }
}

void MeshBuilder::fail_index(std::int64_t index, std::size_t place, std::string_view why) const {
  fail(place,
       "vertex index " + std::to_string(index + first_index_) + " out of range (" + std::string(why) + ")");
}

void MeshBuilder::check(std::span<const VertexId> corners, std::size_t place) const {
  for (const VertexId v : corners)
    if (v.index() >= vertices_.size())
      fail_index(v.value, place, "the file has " + std::to_string(vertices_.size()) + " vertices");
}

/// One that is named twice, or none.
VertexId MeshBuilder::repeated_vertex(std::span<const VertexId> corners) {
  if (corners.size() == 3) {
    const VertexId a = corners[0], b = corners[1], c = corners[2];
    return a == b || a == c ? a : (b == c ? b : VertexId());
  }
  std::vector<VertexId> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  return twice == sorted.end() ? VertexId() : *twice;
}

void MeshBuilder::append_triangles(std::span<const VertexId> corners, Facets& facets) const {
  if (corners.size() == 3) {
    facets.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  std::vector<geom::Vec3> polygon;
  polygon.reserve(corners.size());
  for (const VertexId v : corners) polygon.push_back(vertices_[v]);
  const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b, c] : triangulate(polygon)) facets.push_back({corner(a), corner(b), corner(c)});
}

/// What is left of a facet without corners that repeat the one before them, and triangles that still name a
/// vertex twice.
void MeshBuilder::append_the_rest(std::span<const VertexId> corners, Facets& facets) const {
  std::vector<VertexId> rest;
  for (const VertexId v : corners)
    if (rest.empty() || rest.back() != v) rest.push_back(v);
  while (rest.size() > 1 && rest.back() == rest.front()) rest.pop_back();
  if (rest.size() < 3) return;
  Facets triangles;
  append_triangles(rest, triangles);
  for (const auto& [a, b, c] : triangles)
    if (a != b && b != c && c != a) facets.push_back({a, b, c});
}

geom::TriMesh MeshBuilder::finish(std::size_t* repeated) && {
  if (polygons_.empty()) file_->fail("no facets");
  Facets facets;
  facets.reserve(polygons_.size());
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    const std::size_t end = i + 1 < polygons_.size() ? polygons_[i + 1].first : corners_.size();
    const std::span corners(&corners_[polygons_[i].first], end - polygons_[i].first);
    check(corners, polygons_[i].place);
    const VertexId twice = repeated_vertex(corners);
    if (twice.valid() && !repeated)
      fail(polygons_[i].place,
           "a facet names vertex " + std::to_string(twice.value + first_index_) + " twice");
    if (twice.valid())
      append_the_rest(corners, facets), ++*repeated;
    else
      append_triangles(corners, facets);
    if (facets.size() > most_elements) fail(polygons_[i].place, "more than 2^30 facets");
  }
  if (facets.empty()) file_->fail("no facet has three different vertices");
  try {
    return geom::TriMesh(std::move(vertices_), std::move(facets));
  } catch (const geom::InputError& error) {
    file_->fail(error.what());
  }
}

}  // namespace io
