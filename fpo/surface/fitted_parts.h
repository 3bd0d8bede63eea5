#pragma once
// A surface split as little as a function on it allows. Levels that set sheets apart (sheet_levels.h) are
// found on small facets, but are nearly linear over most of the surface; moves cost by the number of facets
// that a cell meets.

#include <optional>
#include <span>

#include "fpo/surface/split_facets.h"

namespace fpo {

/// Values at the vertices of a split surface, linear on its facets.
struct SplitFunction {
  const SplitSurface& split;
  const geom::Table<geom::VertexId, double>& values;
};

/// In wanted lengths.
struct FitOptions {
  double longest;    ///< edge that is never halved
  double largest;    ///< edge that is not halved where the function is linear
  double tolerance;  ///< of the function
};

struct FittedParts {
  SplitSurface surface;
  geom::Table<geom::VertexId, double> values;
};

/// The mesh that was split, its facets cut along the middles of their longest edges (Rivara 1984) until at
/// each vertex of the split surface the function differs from its linear interpolation by no more than the
/// tolerance, or edges are short. A neighbour is cut with them where they share an edge. The
/// old vertices keep their ids; middles are rounded to the exact range (geom/mesh/scaling.h). Samples of the
/// old surface change to the facets of those parts that they are on.
/// Nothing if there would be no fewer parts than the split surface has. O(parts log parts) of that.
std::optional<FittedParts> fitted_parts(const geom::TriMesh& mesh, const Sizing& sizing,
                                        const SplitFunction& function, const FitOptions& options,
                                        std::span<SurfaceSample> samples);

}  // namespace fpo
