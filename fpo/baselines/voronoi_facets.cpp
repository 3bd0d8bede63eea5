#include "fpo/baselines/voronoi_facets.h"

#include <algorithm>

namespace fpo {
namespace {

double largest_coordinate(const geom::TriMesh& mesh) {
  return std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
}

}  // namespace

VoronoiFacets::VoronoiFacets(const geom::TriMesh& surface, int threads)
    : surface_(surface),
      threads_(threads),
      facets_(geom::facets_along_curve(surface)),
      clipper_(surface, sites_, (1 + 1e-9) * largest_coordinate(surface)) {
  std::erase_if(facets_, [&](geom::FacetId t) { return geom::is_degenerate(surface, t); });
}

}  // namespace fpo
