#pragma once
// A neighbourhood of the restricted power diagram, drawn flat.

#include <filesystem>

#include "fpo/remesh/extract.h"
#include "fpo/surface/initial_samples.h"
#include "geom/dual/empty_circles.h"
#include "io/polygons.h"
#include "io/svg.h"

namespace tools {

/// Looks at the cells within a radius of a sample along the normal of its facet.
class TracePicture {
 public:
  /// Keeps a reference to the mesh.
  TracePicture(const geom::TriMesh& mesh, const fpo::SurfaceSample& at, double radius);

  struct Drawing {
    io::Svg svg;  ///< cells, facets' edges, samples; sample x and the circle marked
    std::vector<io::GroupedPolygon> cells;
    /// Writes STEM.svg and STEM.obj (the cells).
    void save(const std::filesystem::path& stem) const;
  };
  Drawing draw(const geom::RestrictedPower& diagram, geom::SiteId x, const geom::EmptyCircle* circle) const;

 private:
  geom::Vec2 project(const geom::Vec3& p) const;
  bool near(const fpo::CellPolygon& polygon) const;

  const geom::TriMesh& mesh_;
  geom::Vec3 center_, normal_, u_, v_;
  double radius_;
};

}  // namespace tools
