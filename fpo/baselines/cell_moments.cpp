#include "fpo/baselines/cell_moments.h"

#include "fpo/baselines/cell_nodes.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::Vec3;

VoronoiMoments::VoronoiMoments(const geom::TriMesh& surface, const Sizing& sizing, double unit_length,
                               int threads)
    : sizing_(sizing), unit_length_(unit_length), facets_(surface, threads) {}

const geom::Table<SiteId, CellMoments>& VoronoiMoments::of(const std::vector<SurfaceSample>& samples) {
  const auto pieces =
      facets_.pieces<Piece>(samples, [&](const geom::FacetPolygon& polygon, std::vector<Piece>& out) {
        out.push_back({polygon.owner, integrate(polygon)});
      });
  moments_.assign(samples.size(), CellMoments());
  for (const std::vector<Piece>& of_lane : pieces)
    for (const Piece& piece : of_lane) moments_[piece.site] += piece.moments;
  return moments_;
}

CellMoments VoronoiMoments::integrate(const geom::FacetPolygon& polygon) const {
  const Vec3& p = facets_.sites()[polygon.owner].position;
  CellMoments sum;
  each_node(polygon, [&](const Vec3& x, double area) {
    const double mass = area * density(x, polygon.facet);
    sum += {mass, mass * (x - p), mass * (x - p).squaredNorm()};
  });
  return sum;
}

double VoronoiMoments::density(const Vec3& x, FacetId t) const {
  if (sizing_.is_uniform()) return 1;
  const double ratio = unit_length_ / sizing_.at(SurfaceSample{x, t});
  return ratio * ratio * ratio * ratio;
}

}  // namespace fpo
