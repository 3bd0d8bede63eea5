#pragma once
// A neighbourhood of the restricted power diagram, drawn flat.

#include <filesystem>
#include <string>

#include "fpo/remesh/extract.h"
#include "fpo/surface/initial_samples.h"
#include "geom/dual/empty_circles.h"
#include "io/polygons.h"
#include "io/svg.h"

namespace tools {

/// Looks from outside, along the normal of a sample's facet, at the cells within a radius of it on the sheet
/// that it lies on: facets that are joined to its own there and face the same way. What is farther away is
/// drawn first, so that folds of the sheet hide what lies behind them.
class TracePicture {
 public:
  /// Keeps a reference to the mesh.
  TracePicture(const geom::TriMesh& mesh, const fpo::SurfaceSample& at, double radius);

  struct Drawing {
    io::Svg svg;  ///< cells, samples, a caption; sample x and the circle marked
    std::vector<io::GroupedPolygon> cells;
    /// Writes STEM.svg and STEM.obj (the cells).
    void save(const std::filesystem::path& stem) const;
  };
  /// `title`: the caption's first line.
  Drawing draw(const geom::RestrictedPower& diagram, geom::SiteId x, const geom::EmptyCircle* circle,
               const std::string& title) const;

 private:
  geom::Vec2 project(const geom::Vec3& p) const;
  bool in_sight(geom::FacetId t) const;
  void find_sheet(geom::FacetId from);
  bool near(const fpo::CellPolygon& polygon) const;
  /// The cells to be drawn, the farthest from the viewer first.
  std::vector<fpo::CellPolygon> visible(const geom::RestrictedPower& diagram) const;
  bool is_seen(const geom::Vec3& p, geom::FacetId t) const;

  const geom::TriMesh& mesh_;
  geom::Vec3 center_, normal_, u_, v_;
  double radius_;
  std::vector<geom::FacetId> sheet_;  ///< ascending
};

}  // namespace tools
