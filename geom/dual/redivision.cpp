#include "geom/dual/redivision.h"

#include <algorithm>
#include <limits>

#include "geom/dual/chains.h"
#include "geom/power/divided_surface.h"

namespace geom {

void Redivision::build(int threads, DualChange& change) {
  state_.circles.reserve(state_.sites.size());
  EdgeChains chains(state_);
  Table<SiteId, double> reach(state_.sites.size(), Reaches::of_nothing);
  const DividedSurface surface{state_.mesh, state_.sites, state_.clipper, state_.search.tree()};
  surface.for_each(state_.facets.order(), threads, [&](FacetId t, std::span<const FacetPiece> pieces) {
    EmptyCircle circle;
    for (const auto& [owner, corners] : pieces) {
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (state_.corners.find({t, owner, corners}, k, circle))
          change.circles_created.push_back(state_.circles.create(circle));
      reach[owner] = std::max(reach[owner], state_.clipper.bound_power(t, owner, corners));
    }
    chains.add(t, pieces);
  });
  for (SiteId s(0); s.index() < state_.sites.size(); s = SiteId(s.value + 1))
    if (reach[s] > Reaches::of_nothing) state_.reach.set(s, reach[s]);
}

}  // namespace geom
