#pragma once
// Capacity-constrained surface triangulation [XHGL12]: Y. Xu, R. Hu, C. Gotsman, L. Liu, Blue noise sampling
// of surfaces, 2012; in the plane Y. Xu et al., Capacity-constrained Delaunay triangulation for point
// distributions, 2011. CCST in the paper's tables.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Minimizes V(X) = sum over the triangles t of (c_t - c)^2, c_t = d_t A_t the capacity of a triangle of area
/// A_t, d_t the mean of h^-2 at its corners (1 if the sizing is uniform), c the mean capacity. As in the
/// publication two steps alternate, from first_samples() on:
///   geometry: one sample after the other goes to where the triangles around it have the least V. With
///     A_t(x + v) = A_t + a_t . v, a_t = n_t x (q - p) / 2 for the edge p q opposite to x and the normal n_t,
///     that is v in the tangent plane with (sum d_t^2 a_t a_t') v = - sum d_t a_t (c_t - c), a system of two
///     equations. Then it is put back on the surface. It moves by h / 2 at most, and only if V around it
///     sinks.
///   topology: the samples are triangulated anew, as the dual of their restricted Voronoi diagram (Delaunay).
/// options.max_iterations counts the pairs of steps; after the last one the set of the least V so far is the
/// result. The publication stops at convergence, of which the criterion is not known here; the paper's rows
/// are those of four pairs (methods.cpp), and more pairs go on lowering V. Reached "triangle_cv": the
/// standard deviation of the c_t over their mean. O(n log n + fragments) an iteration. Deterministic. Throws
/// geom::InputError like random_samples().
BaselineResult capacity_constrained_triangulation(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
