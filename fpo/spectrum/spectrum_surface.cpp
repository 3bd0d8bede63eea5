#include "fpo/spectrum/spectrum_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geom/check.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/angles.h"

namespace fpo {

using geom::DisjointSets;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;

namespace {

const double crease_cosine = std::sqrt(0.5);  // 45 degrees
constexpr std::size_t most_pieces = 50'000'000;

std::size_t corner_index(FacetId t, int i) { return 3 * t.index() + static_cast<std::size_t>(i); }

int corner_at(const TriMesh& mesh, FacetId t, geom::VertexId v) {
  for (int i = 0; i < 3; ++i)
    if (mesh.facet(t)[static_cast<std::size_t>(i)] == v) return i;
  throw geom::Bug("facets across an edge do not share its ends");
}

/// Corners of one vertex on one side of all creases share a group.
DisjointSets smooth_corners(const TriMesh& mesh) {
  DisjointSets groups(3 * mesh.num_facets());
  for (std::size_t f = 0; f < mesh.num_facets(); ++f) {
    const FacetId t(f);
    for (int e = 0; e < 3; ++e) {
      const FacetId s = mesh.across(t, e);
      if (!s.valid() || s < t) continue;
      const Vec3 a = mesh.normal(t).normalized(), b = mesh.normal(s).normalized();
      if (!(a.dot(b) > crease_cosine)) continue;
      for (const int i : {e, (e + 1) % 3}) {
        const geom::VertexId v = mesh.facet(t)[static_cast<std::size_t>(i)];
        groups.merge_to_least(corner_index(t, i), corner_index(s, corner_at(mesh, s, v)));
      }
    }
  }
  return groups;
}

geom::Table<FacetId, std::array<Vec3, 3>> corner_normals(const TriMesh& mesh) {
  DisjointSets groups = smooth_corners(mesh);
  std::vector<Vec3> sum(3 * mesh.num_facets(), Vec3::Zero());
  for (std::size_t f = 0; f < mesh.num_facets(); ++f)
    for (int i = 0; i < 3; ++i)
      sum[groups.find(corner_index(FacetId(f), i))] +=
          geom::corner_angle(mesh, FacetId(f), i) * mesh.normal(FacetId(f)).normalized();
  geom::Table<FacetId, std::array<Vec3, 3>> normals(mesh.num_facets());
  for (std::size_t f = 0; f < mesh.num_facets(); ++f)
    for (int i = 0; i < 3; ++i)
      normals[FacetId(f)][static_cast<std::size_t>(i)] =
          sum[groups.find(corner_index(FacetId(f), i))].normalized();
  return normals;
}

Vec3 at(const std::array<Vec3, 3>& corners, const Vec3& barycentric) {
  return barycentric[0] * corners[0] + barycentric[1] * corners[1] + barycentric[2] * corners[2];
}

/// A cell of a cubic grid whose cells have size 2^level, and the octant of the normal.
struct Bin {
  int level = 0, octant = 0;
  std::array<std::int64_t, 3> cell{};
  auto operator<=>(const Bin&) const = default;
};

Bin bin_of(const SurfacePiece& piece, const Vec3& origin, double size) {
  Bin bin;
  bin.level = static_cast<int>(std::floor(std::log2(size)));
  const double cell = std::exp2(bin.level);
  for (Eigen::Index k = 0; k < 3; ++k) {
    bin.cell[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(std::floor((piece.at.position[k] - origin[k]) / cell));
    bin.octant = 2 * bin.octant + (piece.at.normal[k] < 0 ? 1 : 0);
  }
  return bin;
}

/// Joins the pieces of each bin: mean position, mean normal. Pieces that fill their bin stay as they are.
std::vector<SurfacePiece> joined(const std::vector<SurfacePiece>& pieces, const Vec3& origin,
                                 const SpectrumSurface::Limit& limit) {
  std::vector<SurfacePiece> result;
  std::vector<std::pair<Bin, std::size_t>> order;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double allowed = limit(pieces[i].at);
    if (4 * pieces[i].area > allowed)
      result.push_back(pieces[i]);
    else
      order.emplace_back(bin_of(pieces[i], origin, std::sqrt(allowed)), i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    SurfacePiece sum{.at = {.position = Vec3::Zero(), .normal = Vec3::Zero()}, .area = 0};
    for (; last < order.size() && order[last].first == order[first].first; ++last) {
      const SurfacePiece& p = pieces[order[last].second];
      sum.area += p.area;
      sum.at.position += p.area * p.at.position;
      sum.at.normal += p.area * p.at.normal;
    }
    sum.at.position /= sum.area;
    sum.at.normal.normalize();
    result.push_back(sum);
  }
  return result;
}

}  // namespace

SpectrumSurface::SpectrumSurface(const TriMesh& mesh)
    : mesh_(mesh), tree_(mesh), corner_normals_(corner_normals(mesh)), area_(mesh.area()) {
  geom::require(area_ > 0, "the surface has no area");
}

Vec3 SpectrumSurface::normal(FacetId t, const Vec3& barycentric) const {
  const Vec3 sum = at(corner_normals_[t], barycentric);
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3(0, 0, 1);  // a facet without area
}

SpectrumPoint SpectrumSurface::place(const Vec3& x) const {
  const geom::AabbTree::Closest c = tree_.closest(x);
  return {.position = x, .normal = normal(c.facet, c.barycentric)};
}

double SpectrumSurface::distance(const Vec3& x) const { return std::sqrt(tree_.closest(x).distance2); }

double SpectrumSurface::interpolated(const Vec3& x, const VertexField& values) const {
  const geom::AabbTree::Closest c = tree_.closest(x);
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += c.barycentric[i] * values[mesh_.facet(c.facet)[static_cast<std::size_t>(i)]];
  return sum;
}

/// Splits the part of facet t between three points at the middle of its longest side, until it is small. A
/// sliver is cut along its length, too, so that its pieces are not longer than others are wide.
void SpectrumSurface::bisect(FacetId t, const std::array<Vec3, 3>& barycentric, const Limit& limit,
                             std::vector<SurfacePiece>& out) const {
  const std::array<Vec3, 3> facet{mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
  const std::array<Vec3, 3> q{at(facet, barycentric[0]), at(facet, barycentric[1]),
                              at(facet, barycentric[2])};
  const double area = 0.5 * (q[1] - q[0]).cross(q[2] - q[0]).norm();
  if (area == 0) return;
  std::size_t longest = 0;
  double length2 = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    const double candidate = (q[(e + 1) % 3] - q[e]).squaredNorm();
    if (candidate > length2) longest = e, length2 = candidate;
  }
  const Vec3 center = (barycentric[0] + barycentric[1] + barycentric[2]) / 3;
  const SpectrumPoint middle{.position = at(facet, center), .normal = normal(t, center)};
  const double allowed = limit(middle);
  if (area <= allowed && (length2 <= 4 * allowed || area <= 1e-6 * allowed)) {
    out.push_back({middle, area});
    geom::require(out.size() <= most_pieces, "spacings differ too much for that surface");
    return;
  }
  const std::size_t next = (longest + 1) % 3, apex = (longest + 2) % 3;
  const Vec3 half = (barycentric[longest] + barycentric[next]) / 2;
  bisect(t, {barycentric[longest], half, barycentric[apex]}, limit, out);
  bisect(t, {half, barycentric[next], barycentric[apex]}, limit, out);
}

std::vector<SurfacePiece> SpectrumSurface::pieces(const Limit& limit) const {
  std::vector<SurfacePiece> all;
  for (std::size_t f = 0; f < mesh_.num_facets(); ++f)
    bisect(FacetId(f), {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, limit, all);
  return joined(all, mesh_.box().min(), limit);
}

}  // namespace fpo
