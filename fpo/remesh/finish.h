#pragma once
// What is left to be done on the mesh itself: edges of curves that the RRT lacks (recovered_edges.h), small
// angles (last_angles.h).

#include <memory>

#include "fpo/remesh/dual.h"
#include "fpo/remesh/last_angles.h"

namespace fpo {

struct FinishOptions {
  AngleOptions angles;                  ///< wanted
  bool mend_angles = true;              ///< else edges only
  bool all_wanted = false;              ///< angles, not only 30 degrees, as far as least_edge allows
  double least_edge = 0.9;              ///< then, with uniform sizing, in wanted lengths
  bool keep_cells = false;              ///< the dual's cells follow its samples
  const CurveSlides* slides = nullptr;  ///< of the features; null: samples on curves stay
};

struct Finish {
  std::size_t recovered_edges = 0;
  LastAngles last_angles;
  std::size_t mended_with_delta = 0;  ///< flips and moves kept for all that are wanted
};

/// Of a dual of the domain, of a surface of this type. The domain goes: at once if nobody keeps cells; else,
/// if vertices moved, its samples become the dual's first, and the cells theirs: O(samples moved) updates.
/// Nothing happens to a mesh that has all edges of curves and no small angles. If the mesh is no manifold
/// only edges are made.
Finish finish(std::unique_ptr<SurfaceDomain> domain, const FeatureSamples& features, const WantedType& type,
              const FinishOptions& options, Dual& dual);

}  // namespace fpo
