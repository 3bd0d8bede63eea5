#pragma once
// The library's front door: a surface as two matrices in, its remesh as matrices out.
//
//   fpo::Options options;
//   options.count = 2000;
//   const fpo::Remesh remesh = fpo::remesh(V, F, options);  // remesh.V, remesh.F, ...
//
// What is left out of the options is what fpo-remesh does; the same input, options and seed give the same
// bits. fpo_c.h is the same in C. fpo/remesh/pipeline.h is the longer way in, with the types of this library.

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "fpo/measure/quality.h"
#include "fpo/remesh/effort.h"
#include "fpo/remesh/lengths.h"
#include "fpo/remesh/pipeline.h"
#include "geom/check.h"

namespace fpo {

/// Lengths in the units of V.
struct Options {
  /// Vertices of the remesh: exactly; with Poisson disks, whose parameter is a radius, about. 0: by lengths.
  std::size_t count = 0;
  /// Instead of a count (lengths.h): wanted mean edge, wanted distance from the input, radius of the disks of
  /// mps and cps. With none of them, `sizes` are lengths as they are.
  std::optional<double> edge_length{}, error{}, radius{};
  Effort quality = Effort::best;  ///< how good, how long (effort.h); what else is chosen wins
  Method method = Method::fpo;
  SizingKind sizing = SizingKind::uniform;
  Eigen::VectorXd
      sizes;  ///< if given: wanted edge length at each vertex of V, up to a factor that `count` decides
  SizingLimits limits;  ///< of wanted lengths, unless uniform
  /// Borders, corners and creases are kept: by default those of machined parts; FeatureOptions{.crease_angle
  /// = A, .weak_crease_angle = A}: folds by more than A degrees; none: nothing is.
  std::optional<FeatureOptions> features = automatic_features();
  Eigen::MatrixXd fixed{0, 3};  ///< points of the surface that become vertices: the first ones, bit for bit
  /// As fpo-remesh does with files: facets that name a vertex twice, are repeated, doubled or without area
  /// go, borders that coincide but for rounding are welded (geom/repair/clean.h). A sound surface is not
  /// touched.
  bool clean = true;
  bool at_least = false;  ///< more than `count`, about as many as it takes for the input's type (at_least.h)
  std::uint64_t seed = 1;
  int threads = 0;  ///< at most; 0: all cores. No matter to the result
  /// Stop when the least spacing exceeds it (section 3.2); left out: .926, or what `quality` says.
  std::optional<double> target_delta{};
  bool shortest_edge_removal = false, mend = true, rest = false;
  Sheets sheets = Sheets::automatic;
  bool maximal = false;  ///< in the end samples are moved until their disks cover the surface (maximal.h)
  /// What angle optimization wants, degrees (the largest angle wanted is 156 - 4/3 of it), and how low delta
  /// may become for it and to come closer.
  std::optional<double> min_angle{}, min_delta{};
  geom::CornerTypes corners = geom::CornerTypes::c_only;  ///< where farthest points may be
  Priority farthest = by_radius;                          ///< which empty circle is the farthest point
  /// Left out: what fpo-remesh's help says.
  std::optional<int> iterations{};
  std::optional<Scope> scope{};
  std::optional<double> weight_scale{};
  std::optional<std::size_t> tile_samples{};  ///< 0: no tiles
  std::optional<bool> optimize_angles{}, improve_fidelity{}, come_closer{};
  bool coarse_start = true;  ///< of surfaces with dozens of facets a sample (coarse_start.h)
  /// Looked at before each move: once true, the moves so far are the result.
  const std::atomic<bool>* interrupted = nullptr;
  /// Called after each iteration, and before each move with its number (of about count times iterations),
  /// maybe by other threads, but one at a time. They must not throw.
  std::function<void(const IterationReport&)> on_iteration{};
  std::function<void(std::size_t move)> on_move{};
};

struct RemeshMeasures {
  Quality quality;       ///< of the triangles; all 0 if there is none
  geom::Topology input;  ///< of V, F
  geom::Topology output;
  TypeCheck type;               ///< of the output, component by component
  std::string given_up;         ///< features that are not kept, and why, for users; empty: none
  SizingFit fit;                ///< of edges to wanted lengths
  OptimizeResult optimization;  ///< iterations, moves, and why it ended
  bool converged = false;  ///< whether the last iterations gained nothing (stopped_gaining() in effort.h)
  std::size_t hidden = 0;  ///< samples without a triangle
  std::size_t broken_feature_edges =
      0;  ///< edges between neighbours on curves that are no edges of the remesh
  /// A 2-manifold of the input's topological type.
  bool same_topology() const { return type.ok(); }
};

/// Row i of V, facet, barycentric and wanted is about vertex i.
struct Remesh {
  Eigen::MatrixXd V;            ///< n x 3
  Eigen::MatrixXi F;            ///< m x 3, counterclockwise seen from outside, from 0
  Eigen::VectorXi facet;        ///< n: the row of the input's F in which the vertex lies
  Eigen::MatrixXd barycentric;  ///< n x 3: its coordinates there
  Eigen::VectorXd wanted;       ///< n: wanted edge lengths
  Eigen::VectorXd sizing;       ///< the same at each vertex of the input
  RemeshMeasures measures;
};

/// V: one vertex a row (x, y, z); F: one triangle a row, from 0. Throws geom::InputError on what cannot be
/// remeshed (one line, for users; refusal.h among others), geom::Interrupted if interrupted before there was
/// a result, std::bad_alloc, and geom::Bug.
Remesh remesh(const Eigen::Ref<const Eigen::MatrixXd>& V, const Eigen::Ref<const Eigen::MatrixXi>& F,
              const Options& options);

}  // namespace fpo
