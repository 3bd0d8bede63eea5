#include "fpo/remesh/refusal.h"

#include <string>

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/parts.h"

namespace fpo {

void refuse_soup(const geom::TriMesh& surface, std::size_t parts, std::size_t num_samples) {
  constexpr std::size_t few_parts = 8;
  constexpr double least_samples = 4, most_share = 0.5;
  if (parts <= few_parts) return;
  const double factor = geom::factor_to_unit_box(surface);
  const geom::TriMesh unit = geom::scaled_to_unit_box(surface, factor);
  const double share = geom::share_of_small_parts(unit, static_cast<double>(num_samples), least_samples);
  geom::require(share <= most_share, "the surface is in " + std::to_string(parts) +
                                         " pieces, most of them too small for four of " +
                                         std::to_string(num_samples) + " samples each");
}

bool is_remnant(const geom::TriMesh& remesh) {
  return 4 * geom::topology(remesh).unreferenced_vertices > remesh.num_vertices();
}

void refuse_remnant(const geom::TriMesh& remesh, std::size_t enough) {
  if (!is_remnant(remesh)) return;
  geom::require(
      false, "the surface is thinner than the spacing of " + std::to_string(remesh.num_vertices()) +
                 " samples: only " + std::to_string(geom::topology(remesh).vertices) +
                 " of them have a triangle" +
                 (enough > remesh.num_vertices() ? "; about " + std::to_string(enough) + " would do" : ""));
}

}  // namespace fpo
