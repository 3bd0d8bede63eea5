#pragma once
// What may be done to a remesh for the sake of its angles (last_angles.h), on trial.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "fpo/remesh/edited_mesh.h"
#include "fpo/remesh/facet_region.h"
#include "fpo/remesh/last_angles.h"
#include "fpo/remesh/trial_places.h"

namespace fpo {

/// What counts.
struct AngleRules {
  double good;               ///< in degrees: a facet with a smaller angle is bad
  double smallest, largest;  ///< angles count as far as they are beyond these
  double least_edge;         ///< of a vertex that is moved, in wanted lengths, or as it was
  bool counts = false;       ///< may no more facets be bad?
};

/// Of some facets: the squares of what counts, the smallest angle, and how many are bad.
struct AngleScore {
  double penalty = 0, least = 180;
  std::size_t bad = 0;
};

class AngleEdits {
 public:
  /// Keeps references; vertex i is sample i.
  AngleEdits(const LastAnglesTask& task, const geom::TriMesh& remesh, std::vector<SurfaceSample>& samples);

  AngleRules rules;

  const EditedMesh& mesh() const { return mesh_; }
  /// The bad facets, the worst first.
  std::vector<geom::FacetId> bad() const;
  AngleScore score(const FacetRegion& region) const;
  /// Is its smallest angle one between two edges of curves, and no larger at any of the places() of these?
  bool is_stuck_between_curves(geom::FacetId t);
  /// Is the penalty less, and the smallest angle no smaller, or good?
  bool is_better(const AngleScore& after, const AngleScore& before) const;
  /// The least cosine between normals of facets of the region and their neighbours, edges of curves left out.
  double least_cosine(const FacetRegion& region) const;
  /// All facets that a flip or move at v may change.
  FacetRegion region_at(geom::VertexId v) const {
    return region_of(mesh_, vertices_of(mesh_, region_of(mesh_, {v})));
  }

  /// Where v may be tried.
  std::vector<SurfaceSample> places(geom::VertexId v) { return places_.around(v, sample(v), mesh_); }
  std::optional<SurfaceSample> random_place(geom::VertexId v, geom::Rng& rng) {
    return places_.random(v, sample(v), mesh_, rng);
  }

  /// False, and all as before, if that edge may not be flipped: it is one of a curve, or folded, or the
  /// quadrilateral is not convex.
  bool flip(geom::VertexId a, geom::VertexId b);
  /// With flips around v, in that region. False, and all as before, if an edge becomes too short, or a facet
  /// is turned.
  bool move(geom::VertexId v, const SurfaceSample& to, const FacetRegion& region);
  /// The sample that v is. A move leaves it as it was.
  const SurfaceSample& sample(geom::VertexId v) const { return samples_[v.index()]; }
  void set_sample(geom::VertexId v, const SurfaceSample& x) { samples_[v.index()] = x; }
  std::size_t num_edits() const { return mesh_.num_edits(); }
  void undo_to(std::size_t num_edits) { mesh_.undo_to(num_edits); }

 private:
  bool is_of_curve(geom::VertexId a, geom::VertexId b) const;
  bool may_flip(geom::VertexId a, geom::VertexId b) const;
  bool move_and_flip(geom::VertexId v, const SurfaceSample& to, const FacetRegion& region);
  bool flip_around(geom::VertexId v, const FacetRegion& region);
  double shortest_edge(geom::VertexId v) const;

  const LastAnglesTask& task_;
  std::vector<SurfaceSample>& samples_;
  EditedMesh mesh_;
  TrialPlaces places_;
  std::vector<std::pair<geom::VertexId, geom::VertexId>> chains_;  ///< edges of curves
};

}  // namespace fpo
