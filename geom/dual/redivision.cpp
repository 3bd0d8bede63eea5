#include "geom/dual/redivision.h"

#include <algorithm>
#include <limits>

#include "geom/dual/chains.h"
#include "geom/dual/known_circles.h"
#include "geom/power/divided_surface.h"

namespace geom {

void Redivision::build(int threads, const KnownDiagram& known, DualChange& change) {
  state_.circles.reserve(state_.sites.size());
  create_known(known, state_, change);
  EdgeChains chains(state_, known);
  Table<SiteId, double> reach(state_.sites.size(), Reaches::of_nothing);
  const DividedSurface surface{state_.mesh, state_.sites, state_.clipper, state_.search.tree()};
  const std::vector<FacetId> facets = facets_to_divide(known, state_);
  surface.for_each(facets, threads, [&](FacetId t, std::span<const FacetPiece> pieces) {
    EmptyCircle circle;
    for (const auto& [owner, corners] : pieces) {
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (state_.corners.find({t, owner, corners}, k, circle) && !known.has_circles_of_any(circle))
          change.circles_created.push_back(state_.circles.create(circle));
      reach[owner] = std::max(reach[owner], state_.clipper.bound_power(t, owner, corners));
    }
    chains.add(t, pieces);
  });
  for (SiteId s(0); s.index() < state_.sites.size(); s = SiteId(s.value + 1))
    if (reach[s] > Reaches::of_nothing && !known.has_circles_of(s)) state_.reach.set(s, reach[s]);
}

}  // namespace geom
