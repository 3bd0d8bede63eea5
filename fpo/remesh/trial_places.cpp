#include "fpo/remesh/trial_places.h"

#include <array>

#include "fpo/remesh/nearby_places.h"

namespace fpo {

using geom::SiteId;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double same_sheet = 0.5;  // cosine between normals of the surface
constexpr std::array<double, 5> trial_steps = {0.02, 0.05, 0.1, 0.2, 0.3};  // in wanted lengths
constexpr int num_directions = 8;

}  // namespace

std::vector<SurfaceSample> TrialPlaces::around(VertexId v, const SurfaceSample& now, const EditedMesh& mesh) {
  if (!tree_) tree_.emplace(task_.surface);
  if (v.index() < task_.features.samples.size()) return on_curve(v, now, mesh);
  if (mesh.is_on_border(v)) return {};
  const Vec3 normal = task_.surface.normal(now.facet).normalized();
  std::vector<SurfaceSample> places =
      nearby_places(task_.surface, *tree_, now, {task_.sizing.at(now), trial_steps, num_directions});
  std::erase_if(places, [&](const SurfaceSample& x) {
    return !(task_.surface.normal(x.facet).normalized().dot(normal) > same_sheet) ||
           !is_same_part(x.facet, now.facet);
  });
  return places;
}

std::vector<SurfaceSample> TrialPlaces::on_curve(VertexId v, const SurfaceSample& now,
                                                 const EditedMesh& mesh) {
  const SiteId x(v.value);
  if (!task_.slides || !task_.slides->can_slide(x)) return {};
  const auto [before, after] = task_.slides->neighbours(x);
  std::vector<SurfaceSample> places = task_.slides->places(
      x, now, {mesh.position(VertexId(before.value)), mesh.position(VertexId(after.value))});
  for (SurfaceSample& place : places) place.facet = tree_->closest(place.position, now.facet).facet;
  std::erase_if(places, [&](const SurfaceSample& place) { return !is_same_part(place.facet, now.facet); });
  return places;
}

bool TrialPlaces::is_same_part(geom::FacetId a, geom::FacetId b) {
  if (a == b) return true;
  if (!type_) type_ = geom::surface_type(task_.surface);
  return type_->part_of[a] == type_->part_of[b];
}

}  // namespace fpo
