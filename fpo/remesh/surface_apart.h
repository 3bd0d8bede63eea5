#pragma once
// Whether the sheets of a surface are set apart (fpo/surface/sheet_levels.h) before it is remeshed.

#include <optional>

#include "fpo/remesh/remesh_task.h"
#include "fpo/surface/split_facets.h"

namespace fpo {

/// The share of the surface, by random samples, that is near another sheet of it; 0 if it is not left to us
/// what that leads to.
double share_near_itself(const RemeshTask& task, const SharedSizing& shared, const RemeshOptions& options);

/// The task's surface with its sheets apart, if it has some that are near each other, and that is wanted:
/// with Sheets::apart, or, where that is left to us, if they are near each other on so much of the surface
/// that together they would keep cells from being simple in most moves: `near_itself`, as above. The samples
/// on features are then on facets of the new surface.
std::optional<SplitSurface> surface_apart(const RemeshTask& task, SharedSizing& shared,
                                          const RemeshOptions& options, double near_itself);

/// Whether sheets are near each other, and can be set apart.
bool has_near_sheets(const RemeshTask& task, const SharedSizing& shared, const RemeshOptions& options);

}  // namespace fpo
