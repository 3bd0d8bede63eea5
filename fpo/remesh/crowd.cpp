#include "fpo/remesh/crowd.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fpo/remesh/layers.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/parts.h"

namespace fpo {
namespace {

double layers_of(const geom::TriMesh& unit, double n) {
  return layers_within(unit, std::sqrt(2 * unit.area() / (std::numbers::sqrt3 * n)));
}

}  // namespace

void refuse_crowd(const geom::TriMesh& surface, std::size_t num_samples) {
  constexpr std::size_t few_parts = 8;
  constexpr double least_samples = 30, most_share = 0.5, most_layers = 16;
  if (num_samples == 0 || surface.num_facets() == 0) return;
  const geom::TriMesh unit = geom::scaled_to_unit_box(surface, geom::factor_to_unit_box(surface));
  const auto n = static_cast<double>(num_samples);
  const std::string samples = std::to_string(num_samples) + " samples";

  const auto parts = geom::mesh_parts(unit.vertices(), unit.facets());
  const auto pieces = [&] { return "the surface is in " + std::to_string(parts.size()) + " pieces, "; };
  geom::require(parts.size() <= std::max(few_parts, num_samples), pieces() + "more than the " + samples);
  const auto single = std::ranges::count_if(parts, [](const auto& p) { return p.facets.size() == 1; });
  const bool is_soup = parts.size() > few_parts && 2 * static_cast<std::size_t>(single) > unit.num_facets();
  geom::require(!is_soup || geom::share_of_small_parts(unit, n, least_samples) <= most_share,
                pieces() + "most of them single facets too small for 30 of " + samples + " each");
  const double layers = layers_of(unit, n);
  geom::require(layers <= most_layers, "some " + std::to_string(std::lround(layers)) +
                                           " sheets of the surface lie within the spacing of " + samples +
                                           ", too many to tell apart");
}

void refuse_thread(const geom::TriMesh& surface, std::size_t num_samples) {
  constexpr std::size_t few_samples = 16;
  constexpr double thinnest_tube = 0.6, thinnest_strip = 0.15;
  if (num_samples < few_samples || surface.num_facets() == 0) return;
  const geom::TriMesh unit = geom::scaled_to_unit_box(surface, geom::factor_to_unit_box(surface));
  const bool is_closed = geom::topology(unit).boundary_edges == 0;
  geom::require(!(unit.area() > 0) || layers_of(unit, static_cast<double>(num_samples)) >
                                          (is_closed ? thinnest_tube : thinnest_strip),
                "the surface is thinner than the spacing of " + std::to_string(num_samples) +
                    " samples: hardly any of them would have a triangle");
}

}  // namespace fpo
