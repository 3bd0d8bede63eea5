#pragma once
// A sizing: edges three times as long on top as at the bottom.

#include "fpo/surface/sizing_kinds.h"

namespace fpo {

inline VertexField sizes_by_height(const SizingTask& task) {
  const geom::Box3& box = task.surface.box();
  VertexField rho;
  for (const geom::Vec3& x : task.surface.vertices())
    rho.push_back(1 + 2 * (x.z() - box.min().z()) / (box.max().z() - box.min().z()));
  return rho;
}

}  // namespace fpo
