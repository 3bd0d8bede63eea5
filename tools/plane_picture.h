#pragma once
// Drawings of samples on the flat torus.

#include "fpo/plane_domain.h"
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

}  // namespace tools
