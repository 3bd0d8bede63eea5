#include "fpo/measure/hausdorff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geom/mesh/aabb_tree.h"
#include "geom/parallel.h"

// How far the points of one surface are from the other, d(x), is bounded over a triangle T in two ways:
//
//   d is 1-Lipschitz:           d <= d(m) + max |q - m| over T's corners q, with m the centroid;
//   distance to one facet f of the other surface is convex, since f is:  d <= max over q of |q - f|.
//
// The second is exact where f is what T is nearest to, the usual case for small T. Triangles that by these
// bounds could exceed the largest distance found so far are divided, those of the largest bound first. The
// whole is exact if the surfaces coincide piecewise, as on flat faces meshed differently: a triangle that
// reaches beyond its nearest facet is cut along the planes that stand on that facet's edges, and its parts
// get their own nearest facets.

namespace fpo {

using geom::AabbTree;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double relative_gap = 1e-3, absolute_gap = 1e-6;  // the latter in diagonals
constexpr std::size_t max_cells = 300'000;                  // besides two a facet
constexpr std::size_t grain = 128;                          // facets or cells a thread takes at a time
constexpr std::size_t batch_size = 2048;  // cells divided before the largest distance is looked at again

// The quadrature's triangles have no edge longer than a square of this share of the surface.
constexpr double quadrature_share = 1e-4;
constexpr double max_parts = 4e5;  // of them; well shaped facets take a fifth of that

/// A point of one surface and what is nearest to it on the other.
struct Probe {
  Vec3 position{0, 0, 0};
  FacetId nearest;
  double distance = 0;
};

/// A part of a facet.
struct Cell {
  std::array<Probe, 3> corners;
  FacetId nearest;   ///< to the centroid
  double bound = 0;  ///< of the distance of its points
};

std::array<Vec3, 3> positions(const Cell& cell) {
  return {cell.corners[0].position, cell.corners[1].position, cell.corners[2].position};
}
double edge_length(const std::array<Vec3, 3>& q, std::size_t e) { return (q[(e + 1) % 3] - q[e]).norm(); }
std::size_t longest_edge(const std::array<Vec3, 3>& q) {
  std::size_t longest = 0;
  for (const std::size_t e : {1, 2})
    if (edge_length(q, e) > edge_length(q, longest)) longest = e;
  return longest;
}
Vec3 centroid(const Cell& cell) {
  return (cell.corners[0].position + cell.corners[1].position + cell.corners[2].position) / 3;
}

/// A convex polygon divided by a plane; corners on the plane belong to both parts.
struct Halves {
  std::vector<Probe> inside, outside;
};

/// From one surface to the other.
class OneSided {
 public:
  OneSided(const TriMesh& from, const AabbTree& to, int threads) : from_(from), to_(to), threads_(threads) {}

  struct Samples {
    double max = 0, mean_square = 0;
  };
  /// Distances at the vertices and at the points of the quadrature.
  Samples sample();

  struct Range {
    double attained = 0, bound = 0;
  };
  /// The largest distance, given that `attained` is reached somewhere (not necessarily here): divides until
  /// no bound exceeds what is attained by more than the gap. Requires sample().
  Range maximum(double attained, double diagonal) const;

 private:
  struct FacetSum {
    double mean_square = 0, max = 0;
  };
  /// Cells that may matter, and the extremes of those that do not.
  struct Found {
    std::vector<Cell> cells;
    Range range;
  };

  Probe probe(const Vec3& x, FacetId hint) const;
  void probe_vertices();
  FacetSum integrate(FacetId t, double size, double most_parts) const;
  void evaluate(Cell& cell, Found& found, double limit) const;
  void divide(const Cell& cell, Found& found, double limit) const;
  bool carve(const Cell& cell, std::vector<Cell>& parts) const;
  Halves halve(const std::vector<Probe>& polygon, const Vec3& origin, const Vec3& normal, double zero) const;
  std::vector<Cell> bisect(const Cell& cell) const;
  std::vector<Cell> worst(std::vector<Cell>& heap, double limit) const;

  const TriMesh& from_;
  const AabbTree& to_;
  int threads_;
  geom::Table<VertexId, Probe> vertices_;
};

Probe OneSided::probe(const Vec3& x, FacetId hint) const {
  const AabbTree::Closest c = to_.closest(x, hint);
  return {x, c.facet, std::sqrt(c.distance2)};
}

void OneSided::probe_vertices() {
  std::vector<char> used(from_.num_vertices(), 0);
  for (const TriMesh::Facet& facet : from_.facets())
    for (const VertexId v : facet) used[v.index()] = 1;
  vertices_.resize(from_.num_vertices());
  geom::parallel_ranges(used.size(), grain, threads_, [&](std::size_t first, std::size_t last) {
    FacetId hint;
    for (VertexId v(first); v.index() < last; v = VertexId(v.value + 1)) {
      if (!used[v.index()]) continue;
      vertices_[v] = probe(from_.position(v), hint);
      hint = vertices_[v].nearest;
    }
  });
}

// The facet is halved across its longest edges until these are at most `size`, thin facets too, or there are
// most_parts (needles whose length is out of all proportion to the surface's area). In each part
// the three points halfway between centroid and corners, of equal weight, integrate polynomials of degree 2
// exactly, hence the squared distance to a plane.
OneSided::FacetSum OneSided::integrate(FacetId t, double size, double most_parts) const {
  FacetSum sum;
  FacetId hint = vertices_[from_.facet(t)[0]].nearest;
  struct Part {
    std::array<Vec3, 3> corners;
    double share;  // of the facet's area
  };
  std::vector<Part> stack{{{from_.corner(t, 0), from_.corner(t, 1), from_.corner(t, 2)}, 1}};
  while (!stack.empty()) {
    const auto [q, share] = stack.back();
    stack.pop_back();
    const std::size_t e = longest_edge(q);
    const Vec3 &a = q[e], &b = q[(e + 1) % 3], &c = q[(e + 2) % 3];
    if ((b - a).norm() > size && share * most_parts > 1) {
      const Vec3 middle = (a + b) / 2;
      stack.push_back({{a, middle, c}, share / 2});
      stack.push_back({{middle, b, c}, share / 2});
      continue;
    }
    const Vec3 centroid = (a + b + c) / 3;
    for (const Vec3& corner : q) {
      const Probe p = probe((centroid + corner) / 2, hint);
      hint = p.nearest;
      sum.max = std::max(sum.max, p.distance);
      sum.mean_square += share / 3 * p.distance * p.distance;
    }
  }
  return sum;
}

OneSided::Samples OneSided::sample() {
  probe_vertices();
  const double area = from_.area();
  const double size = area > 0 ? std::sqrt(area * quadrature_share) : from_.diagonal();
  const auto longest_of = [&](FacetId t) {
    const std::array q{from_.corner(t, 0), from_.corner(t, 1), from_.corner(t, 2)};
    return edge_length(q, longest_edge(q));
  };
  double length = 0;
  for (FacetId t(0); t.index() < from_.num_facets(); t = FacetId(t.value + 1)) length += longest_of(t);
  const auto most_parts = [&](FacetId t) {
    const double share = (area > 0 ? from_.area(t) / area : 0) + (length > 0 ? longest_of(t) / length : 0);
    return max_parts * share;
  };
  std::vector<FacetSum> sums(from_.num_facets());
  geom::parallel_ranges(sums.size(), grain, threads_, [&](std::size_t first, std::size_t last) {
    for (FacetId t(first); t.index() < last; t = FacetId(t.value + 1))
      sums[t.index()] = integrate(t, size, most_parts(t));
  });
  Samples result;
  for (const Probe& p : vertices_) result.max = std::max(result.max, p.distance);
  double weights = 0;
  for (FacetId t(0); t.index() < sums.size(); t = FacetId(t.value + 1)) {
    const double weight = area > 0 ? from_.area(t) : 1;
    weights += weight;
    result.mean_square += weight * sums[t.index()].mean_square;
    result.max = std::max(result.max, sums[t.index()].max);
  }
  result.mean_square /= weights;
  return result;
}

/// Bounds a cell whose corners are known and keeps it only if that exceeds the limit.
void OneSided::evaluate(Cell& cell, Found& found, double limit) const {
  const auto& [a, b, c] = cell.corners;
  const Vec3 m = centroid(cell);
  const Probe middle = probe(m, a.nearest);
  cell.nearest = middle.nearest;
  found.range.attained =
      std::max({found.range.attained, middle.distance, a.distance, b.distance, c.distance});
  double radius2 = 0;
  for (const Probe& corner : cell.corners) radius2 = std::max(radius2, (corner.position - m).squaredNorm());
  cell.bound = std::min(cell.bound, middle.distance + std::sqrt(radius2));
  for (const FacetId f : {middle.nearest, a.nearest, b.nearest, c.nearest}) {
    double farthest2 = 0;
    for (const Probe& corner : cell.corners)
      farthest2 = std::max(farthest2, geom::closest_point(corner.position, to_.triangle(f)).distance2);
    cell.bound = std::min(cell.bound, std::sqrt(farthest2));
    if (cell.bound <= limit) break;
  }
  if (cell.bound > limit)
    found.cells.push_back(cell);
  else
    found.range.bound = std::max(found.range.bound, cell.bound);
}

Halves OneSided::halve(const std::vector<Probe>& polygon, const Vec3& origin, const Vec3& normal,
                       double zero) const {
  const auto side = [&](const Probe& p) {
    const double s = normal.dot(p.position - origin);
    return std::abs(s) <= zero ? 0 : s;
  };
  Halves result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Probe &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double at_p = side(p), at_q = side(q);
    if (at_p >= 0) result.inside.push_back(p);
    if (at_p <= 0) result.outside.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const Probe cut = probe(p.position + at_p / (at_p - at_q) * (q.position - p.position), p.nearest);
      result.inside.push_back(cut);
      result.outside.push_back(cut);
    }
  }
  return result;
}

/// Cuts off what lies beyond the edges of the facet nearest to the centroid, if the centroid is above the
/// facet's interior and the cell not much larger than the facet. Returns false if there is nothing to cut
/// off: what is beyond an edge by no more than rounding would be cut off again and again.
bool OneSided::carve(const Cell& cell, std::vector<Cell>& parts) const {
  const auto& f = to_.triangle(cell.nearest);
  const auto q = positions(cell);
  const double size = edge_length(q, longest_edge(q));
  if (size > 2 * edge_length(f, longest_edge(f))) return false;
  if (!(geom::closest_point(centroid(cell), f).barycentric.minCoeff() > 0)) return false;
  const Vec3 normal = (f[1] - f[0]).cross(f[2] - f[0]);
  const auto add = [&](const std::vector<Probe>& polygon) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      parts.push_back({{polygon[0], polygon[i - 1], polygon[i]}, FacetId(), cell.bound});
  };
  std::vector<Probe> inside(cell.corners.begin(), cell.corners.end());
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3 inward = normal.cross(f[(e + 1) % 3] - f[e]);
    Halves halves = halve(inside, f[e], inward, 1e-9 * size * inward.norm());
    add(halves.outside);
    inside = std::move(halves.inside);
  }
  if (parts.empty()) return false;
  add(inside);
  return true;
}

/// At the middle of the longest edge.
std::vector<Cell> OneSided::bisect(const Cell& cell) const {
  const std::size_t e = longest_edge(positions(cell));
  const Probe &a = cell.corners[e], &b = cell.corners[(e + 1) % 3], &c = cell.corners[(e + 2) % 3];
  const Probe middle = probe((a.position + b.position) / 2, cell.nearest);
  return {{{a, middle, c}, FacetId(), cell.bound}, {{middle, b, c}, FacetId(), cell.bound}};
}

void OneSided::divide(const Cell& cell, Found& found, double limit) const {
  std::vector<Cell> parts;
  if (!carve(cell, parts)) parts = bisect(cell);
  for (Cell& part : parts) evaluate(part, found, limit);
}

/// Takes up to a batch of cells, those of the largest bounds, off the heap; none that are within the limit.
std::vector<Cell> OneSided::worst(std::vector<Cell>& heap, double limit) const {
  std::vector<Cell> batch;
  while (!heap.empty() && heap.front().bound > limit && batch.size() < batch_size) {
    std::ranges::pop_heap(heap, {}, &Cell::bound);
    batch.push_back(heap.back());
    heap.pop_back();
  }
  return batch;
}

OneSided::Range OneSided::maximum(double attained, double diagonal) const {
  Range range{attained, attained};
  const auto limit = [&] {
    return range.attained + std::max(relative_gap * range.attained, absolute_gap * diagonal);
  };
  std::vector<Cell> heap;
  std::size_t num_cells = 0;
  // Calls work(k, found, limit) for k < count, in parallel, and takes up what it finds, in the order of k.
  const auto gather = [&](std::size_t count, std::size_t step, const auto& work) {
    std::vector<Found> found((count + step - 1) / step);
    geom::parallel_ranges(count, step, threads_, [&, at = limit()](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) work(k, found[first / step], at);
    });
    for (const Found& f : found) {
      range = {std::max(range.attained, f.range.attained), std::max(range.bound, f.range.bound)};
      num_cells += f.cells.size();
      for (const Cell& cell : f.cells) {
        heap.push_back(cell);
        std::ranges::push_heap(heap, {}, &Cell::bound);
      }
    }
  };
  gather(from_.num_facets(), grain, [&](std::size_t k, Found& found, double at) {
    const TriMesh::Facet& facet = from_.facet(FacetId(k));
    Cell cell{{vertices_[facet[0]], vertices_[facet[1]], vertices_[facet[2]]},
              FacetId(),
              std::numeric_limits<double>::infinity()};
    evaluate(cell, found, at);
  });
  while (num_cells < max_cells + 2 * from_.num_facets()) {
    const std::vector<Cell> batch = worst(heap, limit());
    if (batch.empty()) break;
    gather(batch.size(), 16, [&](std::size_t k, Found& found, double at) { divide(batch[k], found, at); });
  }
  if (!heap.empty()) range.bound = std::max(range.bound, heap.front().bound);
  range.bound = std::max(range.bound, range.attained);
  return range;
}

}  // namespace

SurfaceDistance surface_distance(const TriMesh& mesh, const TriMesh& reference, int threads) {
  const AabbTree mesh_tree(mesh), reference_tree(reference);
  OneSided out(mesh, reference_tree, threads), back(reference, mesh_tree, threads);
  const OneSided::Samples s = out.sample(), r = back.sample();
  const double diagonal = reference.diagonal();
  const OneSided::Range first = out.maximum(std::max(s.max, r.max), diagonal);
  const OneSided::Range both = back.maximum(first.attained, diagonal);
  const double bound = std::max(first.bound, both.bound);
  const double rms = std::sqrt(std::max(s.mean_square, r.mean_square));
  return {both.attained, bound, std::min(rms, bound)};  // sums round
}

}  // namespace fpo
