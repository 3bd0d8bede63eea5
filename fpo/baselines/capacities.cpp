#include "fpo/baselines/capacities.h"

#include "fpo/baselines/cell_nodes.h"

namespace fpo {

using geom::FacetId;
using geom::FacetPolygon;
using geom::SiteId;
using geom::Vec3;

CellCapacity& CellCapacity::operator+=(const CellCapacity& other) {
  capacity += other.capacity, mass += other.mass, first += other.first, second += other.second;
  return *this;
}

Capacities::Capacities(const geom::TriMesh& surface, const Sizing& sizing, double unit_length, int threads)
    : surface_(surface), sizing_(sizing), unit_length_(unit_length), facets_(surface, threads) {}

Capacities::Diagram Capacities::of(const std::vector<SurfaceSample>& samples) {
  const auto pieces =
      facets_.pieces<Piece>(samples, [&](const FacetPolygon& polygon, std::vector<Piece>& out) {
        Piece& piece = out.emplace_back(Piece{polygon.owner, integrate(polygon), {}});
        for (std::size_t k = 0; k < polygon.corners.size(); ++k)
          if (polygon.corners[k].edge.is_site())
            piece.walls.push_back({polygon.owner, polygon.corners[k].edge.site(), gain(polygon, k)});
      });
  Diagram result;
  result.cells.assign(samples.size(), CellCapacity());
  for (const std::vector<Piece>& of_lane : pieces)
    for (const Piece& piece : of_lane) {
      result.cells[piece.owner] += piece.cell;
      result.walls.insert(result.walls.end(), piece.walls.begin(), piece.walls.end());
    }
  return result;
}

CellCapacity Capacities::integrate(const FacetPolygon& polygon) const {
  const Vec3& p = facets_.sites()[polygon.owner].position;
  CellCapacity sum;
  each_node(polygon, [&](const Vec3& x, double area) {
    const double d = density(x, polygon.facet), mass = area * d * d;
    sum += {area * d, mass, mass * (x - p), mass * (x - p).squaredNorm()};
  });
  return sum;
}

/// Of the wall that starts at corner k.
Vec3 Capacities::gain(const FacetPolygon& polygon, std::size_t k) const {
  const std::size_t next = geom::next_corner(k, polygon.corners.size());
  const Vec3 &a = polygon.corners[k].point.position, &b = polygon.corners[next].point.position;
  const Vec3& p = facets_.sites()[polygon.owner].position;
  const Vec3 apart = facets_.sites()[polygon.corners[k].edge.site()].position - p;
  const Vec3 normal = surface_.normal(polygon.facet).normalized();
  const double along = (apart - apart.dot(normal) * normal).norm();
  if (!(along > 0)) return Vec3::Zero();  // the wall is the whole facet: it has no place
  const Vec3 middle = (a + b) / 2;
  const Vec3 mean = (density(a, polygon.facet) * (a - p) + 4 * density(middle, polygon.facet) * (middle - p) +
                     density(b, polygon.facet) * (b - p)) /
                    6;
  return (b - a).norm() / along * mean;
}

double Capacities::density(const Vec3& x, FacetId t) const {
  if (sizing_.is_uniform()) return 1;
  const double ratio = unit_length_ / sizing_.at(SurfaceSample{x, t});
  return ratio * ratio;
}

}  // namespace fpo
