#include "fpo/remesh/trial_places.h"

#include <array>
#include <cmath>
#include <numbers>

#include "fpo/remesh/nearby_places.h"

namespace fpo {

using geom::SiteId;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double same_sheet = 0.5;  // cosine between normals of the surface
constexpr std::array<double, 5> trial_steps = {0.02, 0.05, 0.1, 0.2, 0.3};  // in wanted lengths
constexpr int num_directions = 8;
constexpr double least_step = 0.004;  // of those at random

}  // namespace

std::vector<SurfaceSample> TrialPlaces::around(VertexId v, const SurfaceSample& now, const EditedMesh& mesh) {
  if (!tree_) tree_.emplace(task_.surface);
  if (is_on_curve(v)) {
    if (!can_slide(v)) return {};
    return on_curve(task_.slides->places(SiteId(v.value), now, beside_on_curve(v, mesh)), now);
  }
  if (mesh.is_on_border(v)) return {};
  return on_sheet(
      nearby_places(task_.surface, *tree_, now, {task_.sizing.at(now), trial_steps, num_directions}), now);
}

std::optional<SurfaceSample> TrialPlaces::random(VertexId v, const SurfaceSample& now, const EditedMesh& mesh,
                                                 geom::Rng& rng) {
  if (!tree_) tree_.emplace(task_.surface);
  const double step = least_step * std::pow(trial_steps.back() / least_step, rng.uniform());
  std::vector<SurfaceSample> places;
  if (is_on_curve(v)) {
    if (!can_slide(v)) return {};
    const double along = rng.uniform() < 0.5 ? step : -step;
    places = on_curve(task_.slides->places(SiteId(v.value), now, beside_on_curve(v, mesh), {&along, 1}), now);
  } else if (!mesh.is_on_border(v)) {
    const CirclesAbout circle{task_.sizing.at(now), {&step, 1}, 1, 2 * std::numbers::pi * rng.uniform()};
    places = on_sheet(nearby_places(task_.surface, *tree_, now, circle), now);
  }
  if (places.empty()) return {};
  return places.front();
}

/// Those of the sheet and part of `now`.
std::vector<SurfaceSample> TrialPlaces::on_sheet(std::vector<SurfaceSample> places,
                                                 const SurfaceSample& now) {
  const Vec3 normal = task_.surface.normal(now.facet).normalized();
  std::erase_if(places, [&](const SurfaceSample& x) {
    return !(task_.surface.normal(x.facet).normalized().dot(normal) > same_sheet) ||
           !is_same_part(x.facet, now.facet);
  });
  return places;
}

/// Those of the part of `now`, with their facets.
std::vector<SurfaceSample> TrialPlaces::on_curve(std::vector<SurfaceSample> places,
                                                 const SurfaceSample& now) {
  for (SurfaceSample& place : places) place.facet = tree_->closest(place.position, now.facet).facet;
  std::erase_if(places, [&](const SurfaceSample& place) { return !is_same_part(place.facet, now.facet); });
  return places;
}

bool TrialPlaces::can_slide(VertexId v) const {
  return task_.slides && task_.slides->can_slide(SiteId(v.value));
}

std::array<Vec3, 2> TrialPlaces::beside_on_curve(VertexId v, const EditedMesh& mesh) const {
  const auto [before, after] = task_.slides->neighbours(SiteId(v.value));
  return {mesh.position(VertexId(before.value)), mesh.position(VertexId(after.value))};
}

bool TrialPlaces::is_same_part(geom::FacetId a, geom::FacetId b) {
  if (a == b) return true;
  if (!type_) type_ = geom::surface_type(task_.surface);
  return type_->part_of[a] == type_->part_of[b];
}

}  // namespace fpo
