#include "fpo/baselines/cell_moments.h"

#include <algorithm>

#include "geom/parallel.h"
#include "geom/sites/site_tree.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::Vec3;

namespace {

double largest_coordinate(const geom::TriMesh& mesh) {
  return std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
}

}  // namespace

VoronoiMoments::VoronoiMoments(const geom::TriMesh& surface, const Sizing& sizing, double unit_length,
                               int threads)
    : surface_(surface),
      sizing_(sizing),
      unit_length_(unit_length),
      threads_(threads),
      facets_(geom::facets_along_curve(surface)),
      clipper_(surface, sites_, (1 + 1e-9) * largest_coordinate(surface)) {
  std::erase_if(facets_, [&](FacetId t) { return geom::is_degenerate(surface, t); });  // no area, no moments
}

const geom::Table<SiteId, CellMoments>& VoronoiMoments::of(const std::vector<SurfaceSample>& samples) {
  geom::SiteTree tree;
  sites_.clear();
  for (const SurfaceSample& x : samples) {
    tree.insert(sites_.next_id(), {x.position, 0});
    sites_.push_back({x.position, 0});
  }
  const std::size_t lanes = static_cast<std::size_t>(threads_), facets = facets_.size();
  std::vector<std::vector<Piece>> pieces(lanes);
  geom::parallel_ranges(lanes, 1, threads_, [&](std::size_t i, std::size_t) {
    geom::FacetCells cells(surface_, sites_, clipper_, tree);
    for (std::size_t k = facets * i / lanes; k < facets * (i + 1) / lanes; ++k)
      for (const geom::FacetPolygon& polygon : cells.divide(facets_[k]))
        pieces[i].push_back({polygon.owner, integrate(polygon)});
  });
  moments_.assign(samples.size(), CellMoments());
  for (const std::vector<Piece>& of_lane :
       pieces)  // in the order of the facets, however many lanes there are
    for (const Piece& piece : of_lane) moments_[piece.site] += piece.moments;
  return moments_;
}

CellMoments VoronoiMoments::integrate(const geom::FacetPolygon& polygon) const {
  const Vec3& p = sites_[polygon.owner].position;
  CellMoments sum;
  for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k) {
    const Vec3 &a = polygon.corners[0].point.position, &b = polygon.corners[k].point.position,
               &c = polygon.corners[k + 1].point.position;
    const double third = (b - a).cross(c - a).norm() / 6;
    for (const Vec3& x : {Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)}) {
      const double mass = third * density(x, polygon.facet);
      sum += {mass, mass * (x - p), mass * (x - p).squaredNorm()};
    }
  }
  return sum;
}

double VoronoiMoments::density(const Vec3& x, FacetId t) const {
  if (sizing_.is_uniform()) return 1;
  const double ratio = unit_length_ / sizing_.at(SurfaceSample{x, t});
  return ratio * ratio * ratio * ratio;
}

}  // namespace fpo
