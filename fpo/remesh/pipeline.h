#pragma once
// Blue-noise remeshing from input surface to output mesh: the paper as one straight-line function.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fpo/features/feature_samples.h"
#include "fpo/features/samples_for_features.h"
#include "fpo/measure/quality.h"
#include "fpo/optimize.h"
#include "fpo/remesh/angles.h"
#include "fpo/remesh/closeness.h"
#include "fpo/remesh/dual.h"
#include "fpo/remesh/edge_advice.h"
#include "fpo/remesh/far_part.h"
#include "fpo/remesh/fidelity.h"
#include "fpo/remesh/final_measures.h"
#include "fpo/remesh/finish.h"
#include "fpo/remesh/maximal.h"
#include "fpo/remesh/methods.h"
#include "fpo/remesh/protect.h"
#include "fpo/remesh/thin_parts.h"
#include "fpo/shortest_edge.h"
#include "fpo/surface/sizing_kinds.h"
#include "fpo/surface/split_facets.h"
#include "fpo/surface/surface_domain.h"
#include "fpo/tiles/tiled_optimize.h"

namespace fpo {

/// Sheets nearer to each other than samples: as the paper's diagram has them, apart (sheet_levels.h), or
/// apart if they are most of the surface (near_sheets.h), or if without that the remesh is of another type or
/// has angles below 30 degrees, and it helps.
enum class Sheets { together, apart, automatic };

/// Whether the remesh is brought closer to the surface than fidelity.h brings it (closeness.h), paid for with
/// delta and time. Left to us: where lengths are even and nothing is in the way, for a while.
enum class Closer { never, automatic, always };

/// Its initial values are plain; those of fpo-remesh depend on one another: remesh_defaults.h.
struct RemeshOptions {
  Method method = Method::fpo;
  std::size_t num_samples = 0;
  std::uint64_t seed = 1;  ///< of the initial samples, which are then moved in turn
  SizingKind sizing = SizingKind::uniform;
  VertexField rho;      ///< if given: wanted edge lengths up to a factor, per vertex of the input
  SizingLimits limits;  ///< unless uniform
  /// If given: features are found, chosen (feature_choice.h, which overrules lengths), sampled and kept. If
  /// they are yielding and the remesh is of the input's type without creases, but not with them, then only
  /// the strong ones are kept, or none; none as well if they alone have many angles below 30 degrees. Those
  /// beside small angles are given up (harmful_creases.h). Teeth of ragged borders are cut off then
  /// (trimmed_remesh.h).
  std::optional<FeatureOptions> features;
  bool strong_creases_only = false;    ///< from the beginning (SamplingPlan)
  std::vector<geom::Vec3> fixed;       ///< points of the surface, which become vertices exactly
  SurfaceOptions surface;              ///< its seed, threads and number of fixed samples are overruled
  bool shortest_edge_removal = false;  ///< before the optimization (section 4.3); fpo only
  /// Its seed and order are overruled. Other methods than fpo heed the greatest number of iterations (of
  /// radii tried, with disks), the interruption and the callbacks.
  OptimizeOptions optimize;
  /// All iterations of fpo but the last on a coarser surface where cells have dozens of facets
  /// (coarse_start.h). Not with shortest edge removal.
  bool coarse_start = true;
  /// All of it on such a surface, where the input is thin and denser still (stand_in_remesh.h), if that has
  /// no angle below 30 degrees; else on the input as well, and the better one is taken. Not without
  /// coarse_start.
  bool coarse_for_all = true;
  /// Where sheets near each other put cells at fault early, what is left of the optimization with them
  /// together is left out; if that does not lead to the type and angles it is made after all.
  bool may_cut_short = true;
  double disk_radius = 0;        ///< mps, cps: of the disks, if the sizing is uniform; 0: by num_samples
  std::size_t tile_samples = 0;  ///< in a tile (tiled_optimize.h), if there are more; 0: no tiles
  int threads = 1;               ///< no matter to the result
  Sheets sheets = Sheets::automatic;
  bool facing_samples = false;  ///< of close curves (facing_samples.h); tried if `sheets` is automatic
  /// Where curves face each other all along (facing_curves.h); tried without if `sheets` is automatic.
  bool staggered_samples = true;
  /// At most (thin_parts.h); as many more are tried where few faults are left.
  int rounds_for_thin_parts = ThinPartOptions().rounds;
  bool mend = true;              ///< bring samples to where the remesh is no surface, or of another type
  bool optimize_angles = true;   ///< afterwards (section 5)
  AngleOptions angles;           ///< wanted then; its interruption is overruled
  bool improve_fidelity = true;  ///< where the remesh is farthest from the input (fidelity.h)
  Closer closer = Closer::never;
  double closer_delta = ClosenessOptions().enough_delta;  ///< then delta is not made smaller than this
  bool maximal = false;     ///< then move samples until the set is a maximal Poisson-disk set (maximal.h)
  bool keep_cells = false;  ///< fill RemeshResult::cells
};

struct RemeshResult {
  geom::TriMesh mesh;                  ///< vertex i is sample i; fixed points and features first
  std::vector<SurfaceSample> samples;  ///< position and facet of the input
  VertexField sizing;                  ///< the wanted edge length at each vertex of the input
  VertexField wanted;                  ///< and at each vertex of the mesh
  SizingFit fit;                       ///< of the mesh's edges to them
  double least_length = 0;  ///< in even spacings, if n is too small for the lengths asked for; 0: they hold
  bool has_levels = false;  ///< sheets were near, and are set apart
  bool has_facing_samples = false;   ///< on close curves (facing_samples.h)
  std::size_t feature_samples = 0;   ///< fixed points, corners and samples on curves
  std::size_t staggered_curves = 0;  ///< opposite to the middles of another's edges
  std::size_t feature_edges = 0;     ///< between neighbours on curves
  /// Of these, those that are in the diagram because a ball is empty (proven_edges.h). Not counted (0) where
  /// sheets are apart.
  std::size_t proven_edges = 0;
  std::size_t crease_curves = 0;         ///< curves kept that are creases
  std::size_t crease_edges = 0;          ///< between neighbours on these
  std::string given_up;                  ///< features that are not kept, and why, for users; empty: none
  bool features_missed = false;          ///< and they are of the shape: worth a warning
  std::size_t collapsed_curves = 0;      ///< too short for the spacing
  std::shared_ptr<const Features> kept;  ///< features of this surface that were to be; null: of another
  /// The same with edges cut (crease_cuts.h), if the features are of that; null: they are of the surface.
  std::shared_ptr<const SplitSurface> cut;
  bool strong_only = false;              ///< and they are the strong ones alone
  FeatureBound feature_bound;            ///< how many samples keep all features
  Protection protection;                 ///< of those edges
  std::size_t broken_feature_edges = 0;  ///< those that are no edges of the mesh
  Finish finish;                         ///< what was mended on the mesh
  double corner_angle = 180;             ///< the smallest between features of the input (corner_angles.h)
  std::size_t sharp_corners = 0;         ///< those below 30 degrees
  EdgeAdvice edge_advice;                ///< where, and how many samples would do
  ShortestEdgeResult shortest_edges;
  OptimizeResult optimization;
  /// Of the coarser surface on which the first iterations or, if it was made coarser, all of it was made
  /// (coarse_start.h); 0: there is none.
  std::size_t coarse_facets = 0;
  std::vector<IterationReport> iterations;  ///< of fpo, as on_iteration was told; empty if there is none
  bool cut_short = false;        ///< sheets near each other put cells at fault early (only samples)
  bool stood_in = false;         ///< needles, noise, dense: most was done on another surface (stand_in.h)
  bool made_coarser = false;     ///< dense and thin: on the coarser surface (stand_in_remesh.h)
  double radius_factor = 0;      ///< methods with disks: their radius in units of the wanted edge length
  std::vector<Reached> reached;  ///< the measures that another method than fpo has of itself
  AngleResult angles;
  FidelityResult fidelity;
  ClosenessResult closeness;
  ThinParts thin_parts;
  MaximalResult maximal;
  std::size_t brought = 0;  ///< samples that mending has moved
  TypeCheck type;           ///< of the mesh; with `advice` where and how to mend it
  TypeAdvice advice;
  FarPart far_part;        ///< of the input, with regard to the mesh
  FinalMeasures measures;  ///< of the mesh
  Localization localization;
  std::size_t hidden = 0;          ///< samples without a cell, hence without a triangle
  std::vector<CellPolygon> cells;  ///< the restricted power diagram
  bool by_collapses = false;       ///< the mesh is no dual of that (collapsed_mesh.h)
  /// The same samples joined otherwise (last_resort.h), while it is not settled which is better.
  std::shared_ptr<const RemeshResult> last_resort;
};

/// Remeshes with exactly num_samples vertices; with Poisson disks, whose parameter is a radius, with about as
/// many. Deterministic. If interrupted, the result is that of the moves done; throws geom::Interrupted if
/// that is before the first samples (disks: before the first whole set of them). Computes on a copy of
/// the input that is scaled by a power of two and snapped to multiples of 2^-160 of its size, so that no
/// product in a predicate over- or underflows (geom/mesh/scaling.h), and scales back, which is exact. A body
/// many diagonals away from the origin is computed near it (geom/mesh/centring.h); results are rounded when
/// they are moved back. Throws geom::InputError on an unusable input (no area, or a largest coordinate beyond
/// 2^-900 to 2^900) or number of samples (also too few for the features), geom::Bug with seed and move
/// number.
RemeshResult remesh(const geom::TriMesh& input, const RemeshOptions& options);

}  // namespace fpo
