#include "tools/remesh_points.h"

#include "fpo/spectrum/spectrum_surface.h"
#include "fpo/surface/progressive.h"
#include "geom/mesh/scaling.h"
#include "io/atomic_file.h"
#include "io/attributed_mesh.h"
#include "io/points.h"

namespace tools {

using geom::Vec3;

namespace {

using Values = std::vector<double>;

/// In the unit box, where no square under- or overflows; areas are scaled back.
Values cell_areas(const fpo::RemeshResult& result, double factor) {
  Values areas(result.samples.size(), 0.0);
  for (const fpo::CellPolygon& cell : result.cells)
    for (std::size_t i = 1; i + 1 < cell.corners.size(); ++i) {
      const Vec3 u = factor * (cell.corners[i] - cell.corners[0]),
                 v = factor * (cell.corners[i + 1] - cell.corners[0]);
      areas[cell.site.index()] += 0.5 * u.cross(v).norm();
    }
  for (double& area : areas) area = area / factor / factor;
  return areas;
}

std::array<Values, 3> normals(const geom::TriMesh& input, const std::vector<Vec3>& places, double factor) {
  const fpo::SpectrumSurface surface(geom::scaled(input, factor));
  std::array<Values, 3> result;
  for (const Vec3& x : places) {
    const Vec3 normal = surface.place(x).normal;
    for (std::size_t i = 0; i < 3; ++i) result[i].push_back(normal[static_cast<Eigen::Index>(i)]);
  }
  return result;
}

}  // namespace

void write_points(const RemeshArguments& a, const geom::TriMesh& input, const fpo::RemeshResult& result) {
  if (io::point_format(a.points) != io::PointFormat::ply) {
    std::vector<geom::WeightedPoint3> points;
    for (const fpo::SurfaceSample& sample : result.samples) points.push_back({sample.position, 0});
    return io::write_points(a.points, points);
  }
  const double factor = geom::factor_to_unit_box(input);
  geom::Table<geom::VertexId, Vec3> positions;
  std::vector<Vec3> scaled;
  Values facets, weights, ranks, wanted(result.wanted.begin(), result.wanted.end()), scaled_wanted;
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    positions.push_back(result.samples[i].position);
    scaled.push_back(factor * result.samples[i].position);
    scaled_wanted.push_back(factor * wanted[i]);
    facets.push_back(result.samples[i].facet.value);
    const double radius = a.remesh.surface.weight_factor * wanted[i];
    weights.push_back(radius * radius);
  }
  for (const std::size_t rank : fpo::progressive_ranks(scaled, scaled_wanted))
    ranks.push_back(static_cast<double>(rank));
  const std::array<Values, 3> normal = normals(input, scaled, factor);
  using enum io::PlyType;
  const std::vector<io::VertexProperty> properties{
      {"nx", float64, normal[0]},   {"ny", float64, normal[1]},
      {"nz", float64, normal[2]},   {"area", float64, cell_areas(result, factor)},
      {"facet", int32, facets},     {"size", float64, wanted},
      {"weight", float64, weights}, {"rank", int32, ranks}};
  io::write_file(a.points, io::to_ply(io::AttributedMesh{positions, {}, properties}));
}

}  // namespace tools
