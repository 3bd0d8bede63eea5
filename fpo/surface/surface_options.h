#pragma once
// What a surface domain may be told.

#include <cstddef>
#include <cstdint>
#include <span>

#include "fpo/domain.h"
#include "fpo/farthest.h"
#include "geom/dual/corner_circles.h"
#include "geom/dual/known_cell.h"

namespace fpo {

/// Where neighbours come from: the regular triangulation (the paper's way) or a spatial search. Same results.
enum class Engine { search, triangulation };

/// The factor c with which, by measurement, edge lengths follow h best: their logarithms against those of h
/// have slope 1 +- .05 (bench-adaptive). Local moves keep the density of the initial samples if c is 2/3;
/// global ones carry samples to where they find room, which a larger c must balance.
inline double best_weight_factor(Scope scope) { return scope == Scope::global ? 0.75 : 2.0 / 3; }

struct SurfaceOptions {
  double weight_factor = best_weight_factor(Scope::two_ring);  ///< c
  bool weighted = true;  ///< else the diagram is the Voronoi diagram even if the sizing is not uniform
  Engine engine = Engine::search;
  geom::CornerTypes corners = geom::CornerTypes::c_only;
  std::size_t num_fixed = 0;  ///< the samples with smaller ids stay where they are
  std::uint64_t seed = 1;  ///< of the order in which the oracle is filled (the result does not depend on it)
  int threads = 1;         ///< that build the first diagram; no matter to the result
  Priority farthest = by_radius;  ///< which empty circle is the farthest point
  geom::KnownDiagram known = {};  ///< of the first diagram
};

}  // namespace fpo
