#include "geom/dual/restricted_dual.h"

#include <algorithm>

namespace geom {

RestrictedDual::RestrictedDual(const TriMesh& mesh, CornerTypes types, NeighbourOracle* paper)
    : state_(mesh, types, paper), redivision_(state_), updates_(state_, redivision_) {}

void RestrictedDual::expect(SiteId p, int calls) const {
  if (calls >= 4) return state_.circles.prefetch_list(p), prefetch(&state_.sites[p]);
  if (calls == 3) state_.leeways.expect(p);
  if (calls == 3) return state_.circles.prefetch_members(p);
  for (const CircleId c : circles_of(p)) {
    if (calls == 2) state_.circles.prefetch(c);
    if (calls != 1) continue;
    const EmptyCircle& own = circle(c);
    const std::size_t i = own.index_of(p);
    if (const SiteId s = own.sites[own.after(i)]; s.valid())
      prefetch(&state_.sites[s]), state_.circles.prefetch_list(s);
    if (own.beyond[i].valid()) state_.circles.prefetch(own.beyond[i]);
  }
}

std::vector<CircleId> RestrictedDual::circles() const {
  std::vector<CircleId> found;
  found.reserve(state_.circles.size());
  for (SiteId p(0); p.index() < state_.sites.size(); p = SiteId(p.value + 1))
    for (const CircleId c : circles_of(p))
      if (circle(c).sites[0] == p) found.push_back(c);
  return found;
}

void RestrictedDual::link(SiteId p, std::vector<SiteId>& out) const {
  out.clear();
  for (const CircleId c : circles_of(p))
    for (const SiteId s : circle(c).sites)
      if (s.valid() && s != p) out.push_back(s);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

// A center is in the cell, and at most twice most_tolerance() off. (a - b)^2 >= a^2 (1 - e) - b^2 / e.
double RestrictedDual::least_reach(SiteId p) const {
  constexpr double e = 1e-6;
  const double off = 2 * state_.clipper.most_tolerance();
  double far2 = -off * off / e;
  for (const CircleId c : circles_of(p))
    far2 = std::max(far2, (circle(c).center - site(p).position).squaredNorm() * (1 - e) - off * off / e);
  return circles_of(p).empty() ? Reaches::of_nothing : far2 - site(p).weight;
}

double RestrictedDual::reach(SiteId p) {
  if (!has_cell(p)) return state_.reach[p];
  const double reach = redivision_.reach(p);
  state_.reach.set(p, reach);
  return reach;
}

std::vector<FacetPolygon> RestrictedDual::cell(SiteId p) {
  std::vector<FacetPolygon> polygons;
  const CellPieces& cell = redivision_.cell(p);
  for (const CellPieces::Piece& piece : cell.pieces) {
    const std::span<const PolygonCorner> corners = cell.corners_of(piece);
    polygons.push_back({piece.facet, p, {corners.begin(), corners.end()}});
  }
  std::ranges::sort(polygons, {}, &FacetPolygon::facet);
  return polygons;
}

void RestrictedDual::check() const {
  state_.circles.check();
  state_.search.tree().check();
}

}  // namespace geom
