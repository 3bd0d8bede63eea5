#pragma once
// Where a vertex of a remesh may be tried: on the surface around it, on its curve if it is on one.

#include <array>
#include <optional>
#include <vector>

#include "fpo/remesh/edited_mesh.h"
#include "fpo/remesh/last_angles.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/surface_type.h"
#include "geom/rng.h"

namespace fpo {

class TrialPlaces {
 public:
  /// Keeps a reference.
  explicit TrialPlaces(const LastAnglesTask& task) : task_(task) {}

  /// `now`: the sample that v is. At most a third of the wanted length away, on the same sheet and part of
  /// the surface. None if v must stay, or is on the border and on no curve.
  std::vector<SurfaceSample> around(geom::VertexId v, const SurfaceSample& now, const EditedMesh& mesh);
  /// One of such places, at random.
  std::optional<SurfaceSample> random(geom::VertexId v, const SurfaceSample& now, const EditedMesh& mesh,
                                      geom::Rng& rng);

 private:
  std::array<geom::Vec3, 2> beside_on_curve(geom::VertexId v, const EditedMesh& mesh) const;
  bool can_slide(geom::VertexId v) const;
  bool is_on_curve(geom::VertexId v) const { return v.index() < task_.features.samples.size(); }
  std::vector<SurfaceSample> on_sheet(std::vector<SurfaceSample> places, const SurfaceSample& now);
  std::vector<SurfaceSample> on_curve(std::vector<SurfaceSample> places, const SurfaceSample& now);

  bool is_same_part(geom::FacetId a, geom::FacetId b);

  const LastAnglesTask& task_;
  std::optional<geom::AabbTree> tree_;     ///< made when first needed
  std::optional<geom::SurfaceType> type_;  ///< likewise
};

}  // namespace fpo
