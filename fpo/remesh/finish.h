#pragma once
// What is left to be done on the mesh itself: edges of curves that the RRT lacks (recovered_edges.h), small
// angles (last_angles.h).

#include "fpo/remesh/dual.h"
#include "fpo/remesh/last_angles.h"

namespace fpo {

struct FinishOptions {
  AngleOptions angles;                  ///< wanted
  bool mend_angles = true;              ///< else edges only
  bool keep_cells = false;              ///< the dual's cells follow its samples
  const CurveSlides* slides = nullptr;  ///< of the features; null: samples on curves stay
};

struct Finish {
  std::size_t recovered_edges = 0;
  LastAngles last_angles;
};

/// Of a dual of the domain. If cells are kept the domain's samples are moved with the dual's; else it stays
/// as it is. The type stays, and so does the mesh if it has all edges of curves and no small angles. If the
/// mesh is no manifold only edges are made.
Finish finish(SurfaceDomain& domain, const FeatureSamples& features, const FinishOptions& options,
              Dual& dual);

}  // namespace fpo
