#include "geom/dual/redivision.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/dual/chains.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

// --- divided facets ------------------------------------------------------------------------------

DividedFacets::DividedFacets(const DualState& state)
    : cells_(state.mesh, state.sites, state.clipper, state.tree), range_of_(state.mesh.num_facets(), 0) {}

void DividedFacets::begin() {
  cells_.forget();
  pieces_.clear();
  corners_.clear();
  ranges_.clear();
  facet_of_range_.clear();
}

DividedFacets::Range DividedFacets::of(FacetId t) {
  if (range_of_[t] < ranges_.size() && facet_of_range_[range_of_[t]] == t) return ranges_[range_of_[t]];
  const std::size_t first = pieces_.size();
  for (const FacetPolygon& polygon : cells_.divide(t)) {
    const std::size_t begin = corners_.size();
    corners_.insert(corners_.end(), polygon.corners.begin(), polygon.corners.end());
    pieces_.push_back({polygon.owner, begin, corners_.size()});
  }
  range_of_[t] = static_cast<std::uint32_t>(ranges_.size());
  facet_of_range_.push_back(t);
  ranges_.push_back({first, pieces_.size()});
  return ranges_.back();
}

const DividedFacets::Piece* DividedFacets::find(FacetId t, SiteId owner) {
  const Range range = of(t);
  for (std::size_t i = range.begin; i < range.end; ++i)
    if (pieces_[i].owner == owner) return &pieces_[i];
  return nullptr;
}

// --- updates -------------------------------------------------------------------------------------

Redivision::Redivision(DualState& state)
    : state_(state), divided_(state), stamp_of_(state.mesh.num_facets(), 0) {}

void Redivision::remove(SiteId p, DualChange& change) {
  divided_.begin();
  last_reach_ = facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
  const std::vector<FacetId> facets = facets_;
  if (state_.paper) state_.paper->remove(p);
  state_.tree.remove(p);
  --state_.num_sites;
  if (state_.num_sites == 0) {
    while (!state_.circles.of_site(p).empty()) erase(state_.circles.of_site(p).front(), change);
    return;
  }
  divided_.begin();
  update(facets, {p}, change);
  note_winners(p, facets, change);
  last_power_ = std::max(last_reach_, power_without(p, facets));
  raise_reaches(facets);
  state_.reach[p] = -infinity;
}

// Whoever loses something to p is among the rivals. So no location of the new cell has more power than the farthest
// of their cells.
void Redivision::insert(SiteId p, const WeightedPoint3& point, DualChange& change) {
  state_.admit(p, point);
  if (state_.paper) state_.paper->insert(p, point, state_.num_sites > 0 ? state_.tree.nearest(point.position, SiteId()).site : SiteId());
  state_.tree.insert(p, point);
  ++state_.num_sites;
  std::vector<SiteId> rivals;
  double power = infinity;
  if (state_.num_sites > 1) {
    state_.tree.rivals(p, rivals);
    power = -infinity;
    for (const SiteId j : rivals) power = std::max(power, state_.reach[j]);
  }
  divided_.begin();
  const double reach = facets_of(p, state_.distance_at(power, p), facets_);
  rivals.push_back(p);
  const std::vector<FacetId> facets = facets_;
  update(facets, rivals, change);
  state_.set_reach(p, reach);
  for (const SiteId j : rivals)  // p may have hidden it
    if (j != p && state_.circles.of_site(j).empty())
      state_.set_reach(j, facets_of(j, state_.distance_at(state_.reach[j], j), facets_));
}

void Redivision::build(int threads, DualChange& change) {
  const std::vector<FacetId> order = facets_along_curve(state_.mesh);
  state_.circles.reserve(state_.sites.size());
  EdgeChains chains(state_);
  const DividedSurface surface{state_.mesh, state_.sites, state_.clipper, state_.tree};
  surface.for_each(order, threads, [&](FacetId t, std::span<const FacetPiece> pieces) {
    EmptyCircle circle;
    for (const auto& [owner, corners] : pieces) {
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (state_.corner_circle({t, owner, corners}, k, circle))
          change.circles_created.push_back(state_.circles.create(circle));
      state_.reach[owner] = std::max(state_.reach[owner], state_.clipper.bound_power(t, owner, corners));
    }
    chains.add(t, pieces);
  });
  for (SiteId s(0); s.index() < state_.sites.size(); s = SiteId(s.value + 1))
    if (state_.reach[s] > -infinity) state_.tree.set_reach(s, state_.reach[s]);
}

double Redivision::reach(SiteId p) {
  divided_.begin();
  return facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
}

double Redivision::reach_beside(SiteId heir, SiteId p) {
  std::vector<FacetPolygon> polygons;
  cell(heir, polygons);
  double reach = -infinity;
  for (FacetPolygon& polygon : polygons)
    if (state_.clipper.clip(polygon, p) != Clip::swallowed)
      reach = std::max(reach, state_.clipper.bound_power(polygon));
  return reach;
}

void Redivision::cell(SiteId p, std::vector<FacetPolygon>& out) {
  divided_.begin();
  facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
  for (const FacetId t : facets_)
    if (divided_.has_part(p, t, out.emplace_back()) == false) out.pop_back();
}

double Redivision::facets_of(SiteId p, double radius, std::vector<FacetId>& out) {
  out.clear();
  near_.clear();
  double reach = -infinity;
  if (!(radius > 0)) return reach;
  state_.facets.near(state_.sites[p].position, radius, near_);
  for (const FacetId t : near_) {
    if (!divided_.has_part(p, t, polygon_)) continue;
    out.push_back(t);
    reach = std::max(reach, state_.clipper.bound_power(polygon_));
  }
  return reach;
}

/// The present sites have divided these facets anew, and no others. `involved`: all that owned something there before
/// and may own nothing there now, and any others.
void Redivision::update(std::span<const FacetId> facets, std::vector<SiteId> involved, DualChange& change) {
  ++stamp_;
  open_.clear();
  for (const FacetId t : facets) stamp_of_[t] = stamp_;
  find_circles(facets);
  for (const FacetId t : facets) {
    const DividedFacets::Range range = divided_.of(t);
    for (std::size_t i = range.begin; i < range.end; ++i) involved.push_back(divided_.piece(i).owner);
  }
  std::ranges::sort(involved);
  involved.erase(std::unique(involved.begin(), involved.end()), involved.end());
  compare_circles(involved, change);
  const std::size_t of_neighbours = open_.size();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (is_registered_[i]) continue;
    const CircleId c = state_.circles.create(found_[i]);
    change.circles_created.push_back(c);
    if (found_[i].is_triangle())
      for (std::size_t side = 0; side < 3; ++side) open_.push_back({c, side});
  }
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const bool is_alive = i >= of_neighbours || !std::ranges::binary_search(change.circles_erased, open_[i].circle);
    if (is_alive) connect(open_[i]);
  }
}

/// All that are to be registered on these facets, in order.
void Redivision::find_circles(std::span<const FacetId> facets) {
  found_.clear();
  for (const FacetId t : facets) {
    const DividedFacets::Range range = divided_.of(t);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const DividedFacets::Piece& piece = divided_.piece(i);
      const std::span<const PolygonCorner> corners = divided_.corners(piece);
      EmptyCircle circle;
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (state_.corner_circle({t, piece.owner, corners}, k, circle)) found_.push_back(circle);
    }
  }
  std::ranges::sort(found_, circle_before);
  is_registered_.assign(found_.size(), false);
}

/// Erases those registered on these facets that were not found, and marks the others.
void Redivision::compare_circles(std::span<const SiteId> involved, DualChange& change) {
  std::vector<CircleId> gone;
  for (const SiteId s : involved)
    for (const CircleId c : state_.circles.of_site(s)) {
      const EmptyCircle& circle = state_.circles[c];
      if (circle.sites[0] != s || stamp_of_[circle.facet] != stamp_) continue;
      const auto at = std::ranges::lower_bound(found_, circle, circle_before);
      if (at != found_.end() && !circle_before(circle, *at) && at->clockwise == circle.clockwise)
        is_registered_[static_cast<std::size_t>(at - found_.begin())] = true;
      else
        gone.push_back(c);
    }
  for (const CircleId c : gone) {
    const EmptyCircle& circle = state_.circles[c];
    for (const CircleId other : circle.beyond) {
      if (!other.valid()) continue;
      const std::array<CircleId, 3>& back = state_.circles[other].beyond;
      for (std::size_t side = 0; side < 3; ++side)
        if (back[side] == c) open_.push_back({other, side});
    }
  }
  for (const CircleId c : gone) erase(c, change);
  std::ranges::sort(change.circles_erased);
}

void Redivision::erase(CircleId c, DualChange& change) {
  state_.circles.erase(c);
  change.circles_erased.push_back(c);
}

void Redivision::connect(Side from) {
  const Side to = other_end(from);
  state_.circles.set_beyond(from.circle, from.side, to.circle);
  if (to.circle.valid()) state_.circles.set_beyond(to.circle, to.side, from.circle);
}

//         |  c            The edge of the diagram between a and b, from a corner with c, through one facet after the
//   a  ___*____           other: in each it is the edge labelled b of the polygon of a, and where that ends on a
//       / |  \   b        facet's edge it goes on across.
//      /  |   \ .
Redivision::Side Redivision::other_end(Side from) {
  const EmptyCircle& circle = state_.circles[from.circle];
  const SiteId a = circle.sites[from.side == 0 ? 1 : 0], b = circle.sites[from.side == 2 ? 1 : 2];
  const EdgeLabel along = EdgeLabel::bisector(b);
  FacetId t = circle.facet;
  EdgeLabel start = EdgeLabel::bisector(circle.sites[from.side]);
  for (std::size_t steps = 0; steps <= state_.mesh.num_facets(); ++steps) {
    const DividedFacets::Piece* const piece = divided_.find(t, a);
    if (!piece) break;
    const std::span<const PolygonCorner> corners = divided_.corners(*piece);
    const std::size_t n = corners.size();
    const auto at = static_cast<std::size_t>(std::ranges::find(corners, along, &PolygonCorner::edge) - corners.begin());
    if (at == n) break;
    const EdgeLabel one = corners[previous_corner(at, n)].edge, two = corners[next_corner(at, n)].edge;
    if (one != start && two != start) break;
    const EdgeLabel end = one == start ? two : one;
    if (end.is_site()) {
      const CircleId other = circle_at(t, a, b, end.site());
      if (!other.valid()) break;
      return {other, state_.circles[other].index_of(end.site())};
    }
    const FacetId across = state_.mesh.across(t, end.edge());
    const int e = across.valid() ? same_edge(state_.mesh, t, end.edge(), across) : -1;
    if (e < 0) break;
    t = across;
    start = EdgeLabel::facet_edge(e);
  }
  return {CircleId(), 0};
}

CircleId Redivision::circle_at(FacetId t, SiteId a, SiteId b, SiteId c) const {
  for (const CircleId circle : state_.circles.of_site(a)) {
    const EmptyCircle& found = state_.circles[circle];
    if (found.facet == t && found.is_triangle() && found.touches(b) && found.touches(c)) return circle;
  }
  return CircleId();
}

/// A bound of the power at those corners of the new division where p was nearer.
double Redivision::power_without(SiteId p, std::span<const FacetId> facets) {
  double power = -infinity;
  for (const FacetId t : facets) {
    const DividedFacets::Range range = divided_.of(t);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const DividedFacets::Piece& piece = divided_.piece(i);
      const std::span<const PolygonCorner> corners = divided_.corners(piece);
      const Bisector b = state_.clipper.bisector_of(piece.owner, p);
      if (state_.clipper.classify(t, piece.owner, corners, p, b, beaten_) == Clip::untouched) continue;
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (state_.clipper.beats_at(cell_corner(t, piece.owner, corners, k), p, b))
          power = std::max(power, state_.clipper.bound_power(t, piece.owner, corners.subspan(k, 1)));
    }
  }
  return power;
}

bool Redivision::has_neighbours(SiteId p) {
  divided_.begin();
  facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
  return std::ranges::any_of(facets_, [&](FacetId t) {
    return divided_.has_part(p, t, polygon_) &&
           std::ranges::any_of(polygon_.corners, [](const PolygonCorner& c) { return c.edge.is_site(); });
  });
}

/// Who owns something that p, where it was, is nearer to?
void Redivision::note_winners(SiteId p, std::span<const FacetId> facets, DualChange& change) {
  for (const FacetId t : facets) {
    const DividedFacets::Range range = divided_.of(t);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const DividedFacets::Piece& piece = divided_.piece(i);
      if (std::ranges::find(change.cells, piece.owner) != change.cells.end()) continue;
      const Bisector b = state_.clipper.bisector_of(piece.owner, p);
      if (state_.clipper.classify(t, piece.owner, divided_.corners(piece), p, b, beaten_) != Clip::untouched)
        change.cells.push_back(piece.owner);
    }
  }
  std::ranges::sort(change.cells);
}

void Redivision::raise_reaches(std::span<const FacetId> facets) {
  for (const FacetId t : facets) {
    const DividedFacets::Range range = divided_.of(t);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const DividedFacets::Piece& piece = divided_.piece(i);
      state_.raise_reach(piece.owner, state_.clipper.bound_power(t, piece.owner, divided_.corners(piece)));
    }
  }
}

}  // namespace geom
