#include "fpo/surface/surface_cover.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fpo/surface/surface_sample.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/rng.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double max_points = 20e6;  // ids and memory: about 1 KB a point in the triangulation
const double row_height = std::sqrt(0.75);
constexpr double margin = 0.4;   // of the lattice from the edges, which have points of their own; in spacings
constexpr double stretch = 0.5;  // an edge is divided if longer than the spacing by more than this share
constexpr double jitter = 0.1;   // in spacings

Vec3 direction(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(0, 0, 0);
}

class Cover {
 public:
  Cover(const TriMesh& mesh, double spacing, std::uint64_t seed)
      : mesh_(mesh), spacing_(spacing), rng_(seed) {}

  std::vector<CoverPoint> make() {
    add_vertices();
    if (spacing_ == 0) return std::move(points_);
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
      if (longest_edge(t) <= (1 + stretch) * spacing_) continue;
      add_edges(t);
      add_lattice(t);
    }
    return std::move(points_);
  }

 private:
  void add_vertices();
  double longest_edge(FacetId t) const;
  void add_edges(FacetId t);
  void add_lattice(FacetId t);

  const TriMesh& mesh_;
  double spacing_;
  geom::Rng rng_;
  std::vector<CoverPoint> points_;
};

void Cover::add_vertices() {
  geom::Table<VertexId, Vec3> normal(mesh_.num_vertices(), Vec3(0, 0, 0));
  geom::Table<VertexId, double> longest(mesh_.num_vertices(), -1);
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
    for (int i = 0; i < 3; ++i) {
      const VertexId v = mesh_.facet(t)[i];
      normal[v] += mesh_.normal(t);
      for (const int j : {(i + 1) % 3, (i + 2) % 3})
        longest[v] = std::max(longest[v], (mesh_.corner(t, j) - mesh_.position(v)).norm());
    }
  }
  for (VertexId v(0); v.index() < mesh_.num_vertices(); v = VertexId(v.value + 1)) {
    if (longest[v] < 0) continue;
    points_.push_back({mesh_.position(v), direction(normal[v]), longest[v]});
  }
}

double Cover::longest_edge(FacetId t) const {
  double longest = 0;
  for (int e = 0; e < 3; ++e)
    longest = std::max(longest, (mesh_.corner(t, (e + 1) % 3) - mesh_.corner(t, e)).norm());
  return longest;
}

/// Points on the edges of a facet that no earlier facet has seen.
void Cover::add_edges(FacetId t) {
  for (int e = 0; e < 3; ++e) {
    const FacetId other = mesh_.across(t, e);
    if (other.valid() && other < t) continue;
    const Vec3 &a = mesh_.corner(t, e), &b = mesh_.corner(t, (e + 1) % 3);
    const double pieces = std::ceil((b - a).norm() / spacing_ - stretch);
    if (pieces <= 1) continue;
    const Vec3 normal = direction(mesh_.normal(t) + (other.valid() ? mesh_.normal(other) : Vec3(0, 0, 0)));
    const double longest = std::max(longest_edge(t), other.valid() ? longest_edge(other) : 0);
    for (double i = 1; i < pieces; ++i) {
      const double at = (i + rng_.uniform(-jitter, jitter)) / pieces;
      points_.push_back({geom::snapped(a + at * (b - a)), normal, longest});
    }
  }
}

/// Rows along the first edge, from a random start.
void Cover::add_lattice(FacetId t) {
  const Vec3 edge = mesh_.corner(t, 1) - mesh_.corner(t, 0), side = mesh_.corner(t, 2) - mesh_.corner(t, 0);
  const Vec3 normal = mesh_.normal(t);
  const double doubled_area = normal.norm();
  if (!(doubled_area > 0)) return;
  const double base = edge.norm(), height = doubled_area / base, lean = edge.dot(side) / base;
  // Barycentric coordinates shrink by these per spacing towards the edges.
  const double least_u = margin * spacing_ * side.norm() / doubled_area, least_v = margin * spacing_ / height;
  const double least_w = margin * spacing_ * (side - edge).norm() / doubled_area;
  double shift = rng_.uniform();
  for (double y = rng_.uniform() * row_height * spacing_; y < height;
       y += row_height * spacing_, shift += 0.5) {
    // The row's piece inside the facet, between the sides from corner 0 and from corner 1 to corner 2.
    const double left = y / height * lean, right = base + y / height * (lean - base);
    const double first = spacing_ * (std::ceil(left / spacing_ - shift) + shift);
    for (double x = first; x < right; x += spacing_) {
      const double px = x + spacing_ * rng_.uniform(-jitter, jitter);
      const double py = y + spacing_ * rng_.uniform(-jitter, jitter);
      const double v = py / height, u = (px - v * lean) / base;
      if (u < least_u || v < least_v || 1 - u - v < least_w) continue;
      points_.push_back({location_in_facet(mesh_, t, u, v).position, normal / doubled_area, longest_edge(t)});
    }
  }
}

}  // namespace

// By the areas of the facets and the lengths of their edges.
double cover_size(const TriMesh& mesh, double spacing) {
  double count = static_cast<double>(mesh.num_vertices());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    count += mesh.area(t) / (row_height * spacing * spacing);
    for (int e = 0; e < 3; ++e)
      count += (mesh.corner(t, (e + 1) % 3) - mesh.corner(t, e)).norm() / (2 * spacing);
  }
  return count;
}

std::vector<CoverPoint> surface_cover(const TriMesh& mesh, double spacing, std::uint64_t seed) {
  geom::require(spacing >= 0 && std::isfinite(spacing), "the spacing must be a finite number, at least 0");
  if (spacing > 0)
    geom::require(cover_size(mesh, spacing) <= max_points,
                  "the spacing is too small: it asks for more than 20 million points");
  return Cover(mesh, spacing, seed).make();
}

}  // namespace fpo
