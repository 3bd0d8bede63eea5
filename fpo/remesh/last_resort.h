#pragma once
// A remesh of which the diagram is not of the input's type, or lacks edges of curves, after all that was
// tried: its samples joined by what is left of the surface itself (collapsed_mesh.h).

#include <memory>
#include <span>

#include "fpo/features/curve_slides.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/surface_apart.h"
#include "fpo/remesh/type_check.h"

namespace fpo {

/// How the samples came about.
struct SampledTask {
  const RemeshTask& task;
  const SharedSizing& shared;
  const Sizing& sizing;       ///< of the samples in the end
  const SplitSurface* apart;  ///< null: the samples are on the task's surface
  const WantedType& type;
  const CurveSlides* slides;                     ///< null: samples on curves stay
  std::span<const SurfaceSample> unmended = {};  ///< before faults were mended; none if there were none
};

/// The samples' mesh by collapses, its angles mended (last_angles.h), with what there is to be said of it. Of
/// the unmended ones if mending has not led to the type: it brings samples together, in vain then. If that
/// has not the wanted angles, also of samples spread along the surface, with the lengths of before thin parts
/// were looked at (farthest_vertices.h); the better one (attempts.h). Null if there is none, or nobody asks
/// for it: with other methods than fpo, without mending, and if all is well with the result.
std::shared_ptr<const RemeshResult> last_resort(const SampledTask& sampled, const RemeshOptions& options,
                                                const RemeshResult& result);

/// That of the result if it is better.
RemeshResult or_last_resort(RemeshResult result);

/// Tells the result about the features that it was to keep.
void tell_of_features(const RemeshTask& task, const SharedSizing& shared, RemeshResult& result);
/// And about its lengths and angles.
void tell_of_lengths(const RemeshTask& task, const Sizing& sizing, const AngleOptions& angles,
                     RemeshResult& result);

}  // namespace fpo
