#pragma once
// Drawings of samples in the plane, on the flat torus or a rectangle with a border.

#include "fpo/plane/plane_domain.h"
#include "fpo/remesh/pipeline.h"
#include "io/svg.h"

namespace tools {

struct PlanePicture {
  double width = 800;  ///< pixels
  bool triangulation = false;
  bool cells = false;   ///< the power diagram
  bool disks = false;   ///< of radius sqrt(weight), or if uniform half the wanted edge length
  bool colour = false;  ///< cells by the wanted edge length: red is long, blue short
};

/// One period; what crosses its border appears on both sides.
io::Svg draw_plane(const fpo::PlaneDomain& domain, const PlanePicture& picture);

/// A remesh of rectangle_mesh(size). Without its cells (RemeshOptions::keep_cells) neither they nor colours.
io::Svg draw_rectangle(const fpo::RemeshResult& result, const geom::Vec2& size, const PlanePicture& picture);

}  // namespace tools
