#include "fpo/remesh/unit_box.h"

#include <algorithm>

#include "geom/check.h"
#include "geom/mesh/centring.h"
#include "geom/mesh/scaling.h"

namespace fpo {
namespace {

using geom::Vec3;

constexpr double largest_disk = 16;  // its radius: whoever wants more has one sample as well

constexpr double most_steps = 1.0 / 50;  // of the last place of a coordinate, of the root of a sample's area

/// Every place that a result names beside the vertices of its mesh.
template <class Change>
void change_places(RemeshResult& result, Change change) {
  for (SurfaceSample& sample : result.samples) change(sample.position);
  for (Vec3& place : result.advice.places) change(place);
  change(result.edge_advice.first);
  change(result.far_part.at);
  change(result.measures.least.middle);
  change(result.measures.shortest.middle);
  for (CellPolygon& cell : result.cells)
    for (Vec3& corner : cell.corners) change(corner);
}

RemeshResult remesh_scaled(const geom::TriMesh& input, const RemeshOptions& options,
                           const RemeshFunction& remesh) {
  const double factor = geom::factor_to_unit_box(input);
  const geom::TriMesh surface = geom::scaled_to_unit_box(input, factor);
  geom::require(surface.area() > 0, "the surface has no area");
  RemeshOptions scaled_options = options;
  for (Vec3& point : scaled_options.fixed) point *= factor;
  scaled_options.disk_radius = std::min(scaled_options.disk_radius * factor, largest_disk);
  RemeshResult result = remesh(surface, scaled_options);
  result.mesh = geom::scaled(result.mesh, 1 / factor);
  change_places(result, [&](Vec3& place) { place /= factor; });
  for (double* length :
       {&result.far_part.distance, &result.measures.least.length, &result.measures.shortest.length})
    *length /= factor;
  for (double& h : result.sizing) h /= factor;
  for (double& h : result.wanted) h /= factor;
  return result;
}

}  // namespace

RemeshResult remesh_in_unit_box(const geom::TriMesh& input, const RemeshOptions& options,
                                const RemeshFunction& remesh) {
  const Vec3 middle = geom::far_middle(input);
  if (middle.isZero(0)) return remesh_scaled(input, options, remesh);
  const geom::TriMesh moved = geom::moved_by(input, -middle);
  const double step = 0x1p-52 * middle.lpNorm<Eigen::Infinity>();
  const auto n = static_cast<double>(std::max<std::size_t>(options.num_samples, 1));
  geom::require(step * step * n <= most_steps * most_steps * moved.area(),
                "the surface is so far from the origin that double precision is too coarse for such edges");
  RemeshOptions moved_options = options;
  for (Vec3& point : moved_options.fixed) point -= middle;
  RemeshResult result = remesh_scaled(moved, moved_options, remesh);
  result.mesh = geom::moved_by(result.mesh, middle);
  change_places(result, [&](Vec3& place) { place += middle; });
  return result;
}

}  // namespace fpo
