#include "fpo/baselines/cell_moments.h"

#include <algorithm>
#include <cmath>

#include "geom/parallel.h"

namespace fpo {

using geom::FacetId;
using geom::PolygonCorner;
using geom::SiteId;
using geom::Vec3;

namespace {

constexpr double near_radius = 2;  // in units of h: about 14 sites; cells reach .7 h, so twice that suffices
constexpr double margin = 1 + 1e-9;
constexpr std::size_t grain = 256;

double largest_coordinate(const geom::TriMesh& mesh) {
  return std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
}

/// How far, at most, the polygon reaches from a point.
double reach(const geom::FacetPolygon& polygon, const Vec3& from) {
  double result = 0;
  for (const PolygonCorner& corner : polygon.corners)
    result = std::max(result, (corner.point.position - from).norm() + 2 * corner.point.tolerance);
  return result;
}

}  // namespace

VoronoiMoments::VoronoiMoments(const geom::TriMesh& surface, const Sizing& sizing, double unit_length,
                               int threads)
    : surface_(surface), sizing_(sizing), unit_length_(unit_length) {
  const double extent = margin * largest_coordinate(surface);
  for (int i = 0; i < threads; ++i)
    lanes_.push_back({geom::Clipper(surface, sites_, extent), {}, {}, {}, {}});
}

const geom::Table<SiteId, CellMoments>& VoronoiMoments::of(const std::vector<SurfaceSample>& samples) {
  find_neighbours(samples);
  const std::size_t lanes = lanes_.size(), facets = surface_.num_facets();
  geom::parallel_ranges(lanes, 1, static_cast<int>(lanes), [&](std::size_t i, std::size_t) {
    lanes_[i].pieces.clear();
    for (std::size_t t = facets * i / lanes; t < facets * (i + 1) / lanes; ++t)
      clip_facet(FacetId(t), lanes_[i]);
  });
  moments_.assign(samples.size(), CellMoments());
  for (const Lane& lane : lanes_)  // in the order of the facets, however many lanes there are
    for (const Piece& piece : lane.pieces) moments_[piece.site] += piece.moments;
  return moments_;
}

void VoronoiMoments::find_neighbours(const std::vector<SurfaceSample>& samples) {
  sites_.clear();
  tree_ = geom::SiteTree();
  for (const SurfaceSample& x : samples) {
    tree_.insert(sites_.next_id(), {x.position, 0});
    sites_.push_back({x.position, 0});
  }
  near_.resize(samples.size());
  geom::parallel_ranges(samples.size(), grain, static_cast<int>(lanes_.size()),
                        [&](std::size_t first, std::size_t last) {
                          for (std::size_t i = first; i < last; ++i) {
                            const double radius = near_radius * sizing_.at(samples[i]);
                            near_[SiteId(i)] = {radius, sites_within(SiteId(i), radius)};
                          }
                        });
}

/// Nearest first, p left out.
std::vector<VoronoiMoments::Near> VoronoiMoments::sites_within(SiteId p, double radius) const {
  std::vector<SiteId> found;
  tree_.heirs({p, sites_[p].position, 0, radius * radius}, found);
  std::vector<Near> sites;
  for (const SiteId j : found)
    if (j != p) sites.push_back({(sites_[j].position - sites_[p].position).norm(), j});
  std::ranges::sort(sites);
  return sites;
}

/// The cells on a convex facet hang together: from one owner the labels of its fragment lead to the others.
void VoronoiMoments::clip_facet(FacetId t, Lane& lane) const {
  std::vector<SiteId>& owners = lane.owners;
  owners.assign(1, tree_.nearest(lane.clipper.middle(t), SiteId()).site);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    lane.clipper.start(lane.polygon, t, owners[i]);
    clip_to_cell(lane);
    if (lane.polygon.corners.empty()) continue;
    lane.pieces.push_back({owners[i], integrate(lane.polygon)});
    for (const PolygonCorner& corner : lane.polygon.corners)
      if (corner.edge.is_site() && std::ranges::find(owners, corner.edge.site()) == owners.end())
        owners.push_back(corner.edge.site());
  }
}

void VoronoiMoments::clip_to_cell(Lane& lane) const {
  geom::FacetPolygon& polygon = lane.polygon;
  const Vec3& p = sites_[polygon.owner].position;
  double farthest = reach(polygon, p);
  const auto clip_by = [&](std::span<const Near> sites) {  // false: no site farther away matters
    for (const Near& j : sites) {
      if (j.distance > 2 * margin * farthest) return false;
      if (lane.clipper.clip(polygon, j.site) == geom::Clip::untouched) continue;
      if (polygon.corners.empty()) return false;
      farthest = reach(polygon, p);
    }
    return true;
  };
  const Neighbourhood& near = near_[polygon.owner];
  if (!clip_by(near.sites) || near.radius > 2 * margin * farthest) return;
  std::vector<Near> more = sites_within(polygon.owner, 2 * margin * farthest);
  std::erase_if(more, [&](const Near& j) { return j.distance < near.radius / margin; });
  clip_by(more);
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
