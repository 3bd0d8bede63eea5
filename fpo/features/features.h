#pragma once
// Features of a surface (paper, section 5): borders, creases, edges with more than two facets, and corners,
// "organized in the form of 1D curved skeletons".

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace fpo {

/// Degrees and lengths. Borders and edges with more than two facets are always features.
struct FeatureOptions {
  /// An edge with two facets is a crease if their normals differ by more; 180: no creases. Facets without
  /// area have no normal and make no crease.
  double crease_angle = 45;
  /// What differs by more than this is a crease too if it is joined to one by such edges (hysteresis).
  double weak_crease_angle = 30;
  /// If a smaller share of the creases' length is closed, that is, does not fade out into the surface, there
  /// are neither creases nor apexes: the creases of a machined part end at others, those of noise in nothing.
  double least_closed_share = 0;
  /// A crease that fades out counts as closed if it is at least so long: a thread that runs out.
  double long_as_closed = std::numeric_limits<double>::infinity();
  /// Pieces of creases that fade out, as far as they are shorter, are left out.
  double shortest_fading = 0;
  /// Creases give way where they would do harm (feature_choice.h): they are asked for by nobody.
  bool yielding = false;
  /// A curve that turns by more has a corner there, and so has a curve that comes back to where it began.
  double corner_turn = 60;
  /// Turns are those between chords of this length along the curve on both sides, so that a jagged curve has
  /// no corners but those seen at this scale. 0: between mesh edges.
  double turn_scale = 0;
  /// A vertex with a smaller sum of facet angles around it is a corner though no curve passes: an apex. 0:
  /// none is, for a sample on a sharp tip has too few neighbours to make good angles, or any triangle: apexes
  /// are left to type A corners.
  double apex_angle = 0;
  /// Edges of the mesh, by their ends, that are creases however they are folded: borders of groups, seams,
  /// lines of a drawing. What is no edge with two facets is passed over.
  std::vector<std::array<geom::VertexId, 2>> marked = {};
  /// Edges of the mesh, by their ends, that are no creases however they are folded. What is left is then not
  /// asked whether enough of it is closed.
  std::vector<std::array<geom::VertexId, 2>> unmarked = {};
};

/// A chain of feature edges between corners, or a loop without corner.
struct FeatureCurve {
  std::vector<geom::VertexId> vertices;  ///< in order; of a loop each once, else from corner to corner
  std::vector<geom::FacetId> facets;     ///< a facet at each edge; a loop has as many edges as vertices
  bool loop = false;
  std::size_t sheets = 0;  ///< facets at each edge: 1 border, 2 crease, more: non-manifold
};

double length_of(const geom::TriMesh& mesh, const FeatureCurve& curve);

struct Features {
  std::vector<geom::VertexId> corners;  ///< ascending
  std::vector<FeatureCurve> curves;
  bool empty() const { return corners.empty() && curves.empty(); }
};

/// Creases of machined parts, none on scanned or sculpted shapes, by measurement: on joint, fandisk, anchor,
/// rotor and coupling 86 to 100 percent of the creases are closed; on homer, elephant, venus and other
/// animals up to 47; bunny and eight have none.
FeatureOptions automatic_features();

/// Every feature edge is in one curve, once. Facets lower than 1e-6 of the diagonal are slivers whose normals
/// mean nothing: they are taken to lie in the plane of the facet across their longest edge. Deterministic.
/// O(F log F).
Features find_features(const geom::TriMesh& mesh, const FeatureOptions& options = {});

}  // namespace fpo
