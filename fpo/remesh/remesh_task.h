#pragma once
// What is remeshed: a surface, with the lengths and the features that are wanted of it.

#include <cstddef>
#include <functional>
#include <optional>

#include "fpo/features/curve_spacing.h"
#include "fpo/features/feature_choice.h"
#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Were all lengths the same.
double even_spacing(const geom::TriMesh& surface, const RemeshOptions& options);

/// Beside narrow places.
double curve_gradation(const RemeshOptions& options);

/// Those that the options ask for.
FeatureChoice chosen_features(const geom::TriMesh& surface, const RemeshOptions& options);

/// The wanted lengths for any number of samples, were there no features.
using SizingFor = std::function<Sizing(std::size_t)>;
/// Keeps a reference to the surface.
SizingFor plain_sizing(const geom::TriMesh& surface, const RemeshOptions& options);

/// The same, but even lengths of the remesh are less on blends (blends.h). Keeps references to both.
SizingFor part_sizing(const geom::TriMesh& surface, const Features& features, const RemeshOptions& options);

/// The surface with small facets if there are narrow places that smaller lengths help.
std::optional<NarrowSurface> helpful_narrow_surface(const geom::TriMesh& surface, const Features& features,
                                                    const SizingFor& plain, const RemeshOptions& options);

/// What is remeshed: the input, or the same with smaller facets.
struct RemeshTask {
  const geom::TriMesh& input;
  const SizingFor& plain;
  const NarrowSurface* narrow;  ///< null: where curves are nowhere close to each other
  Features features;
  bool only_apart = false;              ///< there is nothing to do without sheets that are near each other
  const RemeshResult* start = nullptr;  ///< its samples are those to begin with
  const RemeshResult* rival = nullptr;  ///< there is nothing to do if the diagram is far worse (attempts.h)
  const RemeshResult* same = nullptr;   ///< its samples are those that the optimization leads to
  const Features* of_input = nullptr;   ///< where a coarser surface may stand in
  const geom::TriMesh& surface() const { return narrow ? narrow->split.mesh : input; }
};

/// The sizing, and the samples that stay.
SharedSizing sizing_and_features(const RemeshTask& task, const RemeshOptions& options);

}  // namespace fpo
