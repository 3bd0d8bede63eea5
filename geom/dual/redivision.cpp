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

// --- clipped cells -------------------------------------------------------------------------------

ClippedCells::ClippedCells(const DualState& state)
    : cells_(state.mesh, state.sites, state.clipper, state.tree), buckets_(num_buckets, none) {}

void ClippedCells::begin() {
  cells_.forget();
  pieces_.clear();
  corners_.clear();
  std::ranges::fill(buckets_, none);
}

std::span<const PolygonCorner> ClippedCells::part(SiteId owner, FacetId t) {
  std::uint32_t& bucket = buckets_[(owner.index() * 31 + t.index()) % num_buckets];
  for (std::uint32_t i = bucket; i != none; i = pieces_[i].next)
    if (pieces_[i].owner == owner && pieces_[i].facet == t)
      return std::span(corners_).subspan(pieces_[i].begin, pieces_[i].size);
  const bool has_part = cells_.part_of(owner, t, polygon_);
  const auto begin = static_cast<std::uint32_t>(corners_.size());
  if (has_part) corners_.insert(corners_.end(), polygon_.corners.begin(), polygon_.corners.end());
  pieces_.push_back({t, owner, begin, static_cast<std::uint32_t>(corners_.size()) - begin, bucket});
  bucket = static_cast<std::uint32_t>(pieces_.size()) - 1;
  return std::span(corners_).subspan(begin);
}

std::vector<SiteId> ClippedCells::owners(FacetId t) {
  std::vector<SiteId> result;
  for (const FacetPolygon& polygon : cells_.divide(t)) result.push_back(polygon.owner);
  return result;
}

// --- updates -------------------------------------------------------------------------------------

Redivision::Redivision(DualState& state) : state_(state), clipped_(state) {}

void Redivision::remove(SiteId p, DualChange& change) {
  clipped_.begin();
  last_reach_ = facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
  around_.clear();
  around_up_to_.clear();
  for (const FacetId t : facets_) {
    for (const PolygonCorner& corner : clipped_.part(p, t))
      if (corner.edge.is_site()) around_.push_back(corner.edge.site());
    around_up_to_.push_back(static_cast<std::uint32_t>(around_.size()));
  }
  if (state_.paper) state_.paper->remove(p);
  state_.leave(p);
  open_.clear();
  while (!state_.circles.of_site(p).empty()) erase(state_.circles.of_site(p).front(), change);
  last_power_ = last_reach_;
  if (state_.num_sites > 0) {
    clipped_.begin();
    found_.clear();
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      const std::uint32_t first = i == 0 ? 0 : around_up_to_[i - 1];
      divide_vacancy(p, facets_[i], std::span(around_).subspan(first, around_up_to_[i] - first), change);
    }
    create_found(change);
    std::ranges::sort(change.cells);
  }
  state_.reach[p] = -infinity;
}

/// Finds the corners that the present sites have in what p had on the facet, and who won something there. `around`: the
/// sites at its border.
void Redivision::divide_vacancy(SiteId p, FacetId t, std::span<const SiteId> around, DualChange& change) {
  std::vector<SiteId> owners(around.begin(), around.end());
  if (owners.empty()) owners = clipped_.owners(t);  // p had all
  std::ranges::sort(owners);
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  for (std::size_t i = 0; i < owners.size(); ++i) {
    const SiteId s = owners[i];
    const std::span<const PolygonCorner> part = clipped_.part(s, t);
    if (part.empty()) continue;
    const Bisector b = state_.clipper.bisector_of(s, p);
    const Clip outcome = state_.clipper.classify(t, s, part, p, b, beaten_);
    if (outcome == Clip::untouched) continue;
    if (std::ranges::find(change.cells, s) == change.cells.end()) change.cells.push_back(s);
    state_.raise_reach(s, state_.clipper.bound_power(t, s, part));
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (part[k].edge.is_site() && std::ranges::find(owners, part[k].edge.site()) == owners.end())
        owners.push_back(part[k].edge.site());
      if (outcome == Clip::cut && !beaten_[k]) continue;
      last_power_ = std::max(last_power_, state_.clipper.bound_power(t, s, part.subspan(k, 1)));
      EmptyCircle circle;
      if (state_.corner_circle({t, s, part}, k, circle)) found_.push_back(circle);
    }
  }
}

// Whoever loses something to p is among the rivals. So no location of the new cell has more power than the farthest
// of their cells.
void Redivision::insert(SiteId p, const WeightedPoint3& point, DualChange& change) {
  const SiteId hint = state_.num_sites > 0 ? state_.tree.nearest(point.position, SiteId()).site : SiteId();
  state_.admit(p, point);
  if (state_.paper) state_.paper->insert(p, point, hint);
  state_.enter(p);
  rivals_.clear();
  double power = infinity;
  if (state_.num_sites > 1) {
    state_.tree.rivals(p, rivals_);
    power = -infinity;
    for (const SiteId j : rivals_) power = std::max(power, state_.reach[j]);
  }
  clipped_.begin();
  const double reach = facets_of(p, state_.distance_at(power, p), facets_);
  open_.clear();
  erase_beaten(p, rivals_, change);
  found_.clear();
  for (const FacetId t : facets_) {
    const std::span<const PolygonCorner> part = clipped_.part(p, t);
    for (std::size_t k = 0; k < part.size(); ++k) {
      EmptyCircle circle;
      if (state_.corner_circle_of_any({t, p, part}, k, circle)) found_.push_back(circle);
    }
  }
  create_found(change);
  state_.set_reach(p, reach);
  for (const SiteId j : rivals_)  // p may have hidden it
    if (state_.circles.of_site(j).empty() && state_.reach[j] > -infinity)
      state_.set_reach(j, facets_of(j, state_.distance_at(state_.reach[j], j), facets_));
}

void Redivision::erase_beaten(SiteId p, std::span<const SiteId> rivals, DualChange& change) {
  std::vector<CircleId> beaten;
  const double tolerance = 2 * state_.clipper.most_tolerance();
  for (const SiteId j : rivals) {
    const Bisector b = state_.clipper.bisector_of(j, p);
    for (const CircleId c : state_.circles.of_site(j)) {
      const EmptyCircle& circle = state_.circles[c];
      if (circle.sites[0] != j) continue;
      if (state_.clipper.beats_at(state_.corner_of(circle, tolerance), p, b)) beaten.push_back(c);
    }
  }
  for (const CircleId c : beaten) erase(c, change);
}

/// Notes the edges that lose an end.
void Redivision::erase(CircleId c, DualChange& change) {
  const std::array<CircleId, 3> beyond = state_.circles[c].beyond;
  for (const CircleId other : beyond) {
    if (!other.valid()) continue;
    for (std::size_t side = 0; side < 3; ++side)
      if (state_.circles[other].beyond[side] == c) {
        state_.circles.set_beyond(other, side, CircleId());
        open_.push_back({other, side});
      }
  }
  for (std::size_t side = 0; side < 3; ++side) state_.circles.set_beyond(c, side, CircleId());
  state_.circles.erase(c);
  change.circles_erased.push_back(c);
}

/// Creates the circles found, in order, and joins all edges that have no other end.
void Redivision::create_found(DualChange& change) {
  const std::vector<CircleId> erased = change.circles_erased;
  std::erase_if(open_, [&](const Side& s) { return std::ranges::find(erased, s.circle) != erased.end(); });
  std::ranges::sort(found_, circle_before);
  for (const EmptyCircle& circle : found_) {
    const CircleId c = state_.circles.create(circle);
    change.circles_created.push_back(c);
    for (std::size_t side = 0; side < 3 && circle.is_triangle(); ++side) open_.push_back({c, side});
  }
  for (const Side& side : open_)
    if (!state_.circles[side.circle].beyond[side.side].valid()) connect(side);
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
    if (state_.reach[s] > -infinity) state_.set_reach(s, state_.reach[s]);
}

// --- questions -----------------------------------------------------------------------------------

double Redivision::facets_of(SiteId p, double radius, std::vector<FacetId>& out) {
  out.clear();
  near_.clear();
  double reach = -infinity;
  if (!(radius > 0)) return reach;
  state_.facets.near(state_.sites[p].position, radius, near_);
  for (const FacetId t : near_) {
    const std::span<const PolygonCorner> part = clipped_.part(p, t);
    if (part.empty()) continue;
    out.push_back(t);
    reach = std::max(reach, state_.clipper.bound_power(t, p, part));
  }
  return reach;
}

bool Redivision::has_neighbours(SiteId p) {
  clipped_.begin();
  facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
  return std::ranges::any_of(facets_, [&](FacetId t) {
    return std::ranges::any_of(clipped_.part(p, t), [](const PolygonCorner& c) { return c.edge.is_site(); });
  });
}

double Redivision::reach(SiteId p) {
  clipped_.begin();
  return facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
}

void Redivision::cell(SiteId p, std::vector<FacetPolygon>& out) {
  clipped_.begin();
  facets_of(p, state_.distance_at(state_.reach[p], p), facets_);
  for (const FacetId t : facets_) {
    const std::span<const PolygonCorner> part = clipped_.part(p, t);
    out.push_back({t, p, {part.begin(), part.end()}});
  }
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

// --- edges ---------------------------------------------------------------------------------------

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
    const std::span<const PolygonCorner> corners = clipped_.part(a, t);
    const std::size_t n = corners.size();
    const auto at =
        static_cast<std::size_t>(std::ranges::find(corners, along, &PolygonCorner::edge) - corners.begin());
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

}  // namespace geom
