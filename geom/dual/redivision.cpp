#include "geom/dual/redivision.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/dual/chains.h"
#include "geom/power/facet_cells.h"

namespace geom {
namespace {

bool has_side(const EmptyCircle& circle, SiteId a, SiteId b) {
  return circle.is_triangle() && circle.touches(a) && circle.touches(b);
}

}  // namespace

Redivision::Redivision(DualState& state) : state_(state), clipper_(state), division_(state) {}

// --- removal -------------------------------------------------------------------------------------

void Redivision::plan(SiteId p) {
  p_ = p;
  found_.clear();
  heirs_.clear();
  star_.clear();
  links_.clear();
  open_.clear();
  reach_ = clipper_.clip(p, cell_);
  has_neighbours_ =
      std::ranges::any_of(cell_.corners, [](const PolygonCorner& c) { return c.edge.is_site(); });
  for (const CircleId c : state_.circles.of_site(p)) star_.push_back({c, {}});
  power_ = reach_;
  if (state_.num_sites == 1) return division_.clear();
  division_.divide(p, cell_, reach_);
  power_ = division_.power();
  const CellPieces& shares = division_.shares();
  for (const CellPieces::Piece& piece : shares.pieces) {
    const std::span<const PolygonCorner> share = shares.corners_of(piece);
    if (std::ranges::find(heirs_, piece.owner) == heirs_.end()) heirs_.push_back(piece.owner);
    EmptyCircle circle;
    for (std::size_t k = 0; k < share.size(); ++k)
      if (division_.is_new(share, k) && state_.corner_circle({piece.facet, piece.owner, share}, k, circle))
        found_.push_back(circle);
  }
  std::ranges::sort(heirs_);
  std::ranges::sort(found_, circle_before);
  for (const CellPieces::Piece& piece : shares.pieces) add_segments(p, shares, piece);
  join_across();
}

void Redivision::remove(DualChange& change) {
  if (state_.paper) state_.paper->remove(p_);
  state_.leave(p_);
  for (const OwnCircle& own : star_) {
    state_.circles.erase(own.id);
    change.circles_erased.push_back(own.id);
  }
  const std::size_t first = create_found(change);
  for (const auto& [one, two] : links_) connect(one, two, first, change);
  for (const CellPieces::Piece& piece : division_.shares().pieces)
    state_.raise_reach(piece.owner, state_.clipper.bound_power(piece.facet, piece.owner,
                                                               division_.shares().corners_of(piece)));
  change.cells.insert(change.cells.end(), heirs_.begin(), heirs_.end());
  state_.reach[p_] = -infinity;
}

// --- insertion -----------------------------------------------------------------------------------

// Whoever loses something to p is among the rivals. So no location of the new cell has more power than the
// farthest of their cells.
void Redivision::insert(SiteId p, const WeightedPoint3& point, DualChange& change) {
  const SiteId hint =
      state_.paper && state_.num_sites > 0 ? state_.tree.nearest(point.position, SiteId()).site : SiteId();
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
  erase_beaten(p, change);
  const double reach = clipper_.clip(p, power, around_, cell_);
  found_.clear();
  for (const CellPieces::Piece& piece : cell_.pieces)
    for (std::size_t k = 0; k < piece.size; ++k) {
      EmptyCircle circle;
      if (state_.corner_circle_of_any({piece.facet, p, cell_.corners_of(piece)}, k, circle))
        found_.push_back(circle);
    }
  std::ranges::sort(found_, circle_before);
  links_.clear();
  open_.clear();
  for (const CellPieces::Piece& piece : cell_.pieces) add_segments(p, cell_, piece);
  const std::size_t first = create_found(change);
  for (const auto& [one, two] : links_) connect(one, two, first, change);
  connect_outwards(p, first, change);
  state_.set_reach(p, reach);
  for (const SiteId j : rivals_)  // p may have hidden it
    if (state_.circles.of_site(j).empty() && state_.reach[j] > -infinity)
      state_.set_reach(j, clipper_.clip(j, asked_));
}

/// The circles that p beats go; whom they touch is around p.
void Redivision::erase_beaten(SiteId p, DualChange& change) {
  beaten_.clear();
  for (const SiteId j : rivals_)
    for (const CircleId c : state_.circles.of_site(j))
      if (state_.circles[c].sites[0] == j && is_beaten(state_.circles[c], p)) beaten_.push_back(c);
  around_.clear();
  cut_off_.clear();
  for (const CircleId c : beaten_) {
    for (const SiteId s : state_.circles[c].sites)
      if (s.valid() && std::ranges::find(around_, s) == around_.end()) around_.push_back(s);
    for (const CircleId other : state_.circles[c].beyond) {
      if (!other.valid()) continue;
      const EmptyCircle& beyond = state_.circles[other];
      for (std::size_t side = 0; side < 3; ++side) {
        if (beyond.beyond[side] != c) continue;
        state_.circles.set_beyond(other, side, CircleId());
        cut_off_.push_back({other, static_cast<std::uint8_t>(side), beyond.sites[side == 0 ? 1 : 0],
                            beyond.sites[side == 2 ? 1 : 2]});
      }
    }
    state_.circles.erase(c);
    change.circles_erased.push_back(c);
  }
  std::erase_if(cut_off_,
                [&](const OpenSide& s) { return std::ranges::find(beaten_, s.circle) != beaten_.end(); });
}

/// Mostly doubles tell.
bool Redivision::is_beaten(const EmptyCircle& circle, SiteId p) const {
  if (state_.lead_at(circle, state_.sites[p]).positive()) return false;
  return state_.clipper.beats_at(state_.corner_of(circle, 2 * state_.clipper.most_tolerance()), p,
                                 state_.clipper.bisector_of(circle.sites[0], p));
}

std::size_t Redivision::create_found(DualChange& change) {
  const std::size_t first = change.circles_created.size();
  for (const EmptyCircle& circle : found_) change.circles_created.push_back(state_.circles.create(circle));
  return first;
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

// --- edges ---------------------------------------------------------------------------------------

/// The edges of a piece: of p's own cell all, of a share those that are not on p's border, once for both
/// cells.
void Redivision::add_segments(SiteId p, const CellPieces& pieces, const CellPieces::Piece& piece) {
  const std::span<const PolygonCorner> corners = pieces.corners_of(piece);
  const SiteId a = piece.owner;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (!corners[k].edge.is_site()) continue;
    const SiteId b = corners[k].edge.site();
    if (a != p && (b == p || b < a)) continue;
    const SiteId first = std::min(a, b), second = std::max(a, b);
    const End one = end_at(p, piece.facet, first, second, corners[previous_corner(k, n)].edge);
    const End two = end_at(p, piece.facet, first, second, corners[next_corner(k, n)].edge);
    const End start = follow(one, first, second);
    if (start.kind == End::open && two.kind == End::open && start.place == two.place)  // a closed curve
      std::erase_if(open_,
                    [&](const Open& o) { return o.point == two.place && o.a == first && o.b == second; });
    else
      join(start, follow(two, first, second), first, second);
  }
}

/// Where the edge of a and b ends on a facet: at an edge with this label.
Redivision::End Redivision::end_at(SiteId p, FacetId t, SiteId a, SiteId b, EdgeLabel label) const {
  if (label.is_site() && (label.site() != p || a == p || b == p)) {
    const SiteId c = label.site();
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i].facet == t && has_side(found_[i], a, b) && found_[i].touches(c))
        return {End::found, static_cast<std::uint8_t>(found_[i].index_of(c)), static_cast<std::int64_t>(i)};
    return {};
  }
  if (label.is_site()) {
    for (std::size_t i = 0; i < star_.size(); ++i) {
      const EmptyCircle& circle = state_.circles[star_[i].id];
      if (circle.facet == t && has_side(circle, a, b)) return {End::own, 0, static_cast<std::int64_t>(i)};
    }
    return {};
  }
  const FacetId across = state_.mesh.across(t, label.edge());
  const int e = across.valid() ? same_edge(state_.mesh, t, label.edge(), across) : -1;
  if (e < 0) return {};
  return {End::open, 0,
          t < across ? 3 * std::int64_t{t.value} + label.edge() : 3 * std::int64_t{across.value} + e};
}

/// Where the part of the edge that ends at the same point begins, if it is known already.
Redivision::End Redivision::follow(const End& end, SiteId a, SiteId b) {
  if (end.kind != End::open) return end;
  const auto known = std::ranges::find_if(
      open_, [&](const Open& o) { return o.point == end.place && o.a == a && o.b == b; });
  if (known == open_.end()) return end;
  const End other = known->other;
  *known = open_.back();
  open_.pop_back();
  return other;
}

void Redivision::join(const End& one, const End& two, SiteId a, SiteId b) {
  const auto leave_open = [&](const End& end, const End& other) {
    const auto known = std::ranges::find_if(
        open_, [&](const Open& o) { return o.point == end.place && o.a == a && o.b == b; });
    if (known != open_.end())
      known->other = other;
    else
      open_.push_back({end.place, a, b, other});
  };
  if (one.kind == End::open) leave_open(one, two);
  if (two.kind == End::open) leave_open(two, one);
  if (one.kind == End::open || two.kind == End::open) return;
  if (one.kind == End::own) star_[static_cast<std::size_t>(one.place)].inside = two;
  if (two.kind == End::own) star_[static_cast<std::size_t>(two.place)].inside = one;
  if (one.kind != End::own && two.kind != End::own) links_.push_back({one, two});
}

/// Where the edge that comes through a circle of the removed site goes outside of its cell.
Redivision::End Redivision::outside(std::size_t own) const {
  const EmptyCircle& circle = state_.circles[star_[own].id];
  const std::size_t i = circle.index_of(p_);
  const CircleId beyond = circle.beyond[i];
  if (!beyond.valid()) return {};
  for (std::size_t k = 0; k < star_.size(); ++k)
    if (star_[k].id == beyond) return {End::own, 0, static_cast<std::int64_t>(k)};
  const std::size_t side =
      state_.circles[beyond].opposite(circle.sites[i == 0 ? 1 : 0], circle.sites[i == 2 ? 1 : 2]);
  return {End::present, static_cast<std::uint8_t>(side), beyond.value};
}

/// Joins what comes into the cell of the removed site through its circles to what is inside; it may leave the
/// cell and come back.
void Redivision::join_across() {
  const auto go_on = [&](End end, bool is_inside) {
    for (std::size_t steps = 0; end.kind == End::own && steps <= star_.size();
         ++steps, is_inside = !is_inside) {
      const auto own = static_cast<std::size_t>(end.place);
      end = is_inside ? outside(own) : star_[own].inside;
    }
    return end;
  };
  for (std::size_t i = 0; i < star_.size(); ++i) {
    if (!state_.circles[star_[i].id].is_triangle()) continue;
    const End inside = star_[i].inside, outer = outside(i);
    if (outer.kind != End::own) links_.push_back({outer, go_on(inside, true)});
    if (outer.kind == End::own && inside.kind != End::own) links_.push_back({inside, go_on(outer, false)});
  }
}

void Redivision::connect(const End& one, const End& two, std::size_t first_created,
                         const DualChange& change) {
  const auto circle_of = [&](const End& end) {
    return end.kind == End::found
               ? change.circles_created[first_created + static_cast<std::size_t>(end.place)]
           : end.kind == End::present ? CircleId(static_cast<std::size_t>(end.place))
                                      : CircleId();
  };
  const CircleId first = circle_of(one), second = circle_of(two);
  if (first.valid()) state_.circles.set_beyond(first, one.side, second);
  if (second.valid()) state_.circles.set_beyond(second, two.side, first);
}

// An edge of a and b that p has cut ends at p's cell, in new circles. On a facet it is one segment, so if
// another circle of a and b lies in the facet of a new one, these are its two ends. What is left of an edge
// that has lost one end ends in a new circle; if one such edge and one new circle are left, these belong
// together. In other cases the edge is followed.
void Redivision::connect_outwards(SiteId p, std::size_t first_created, const DualChange& change) {
  outwards_.clear();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (!found_[i].is_triangle()) continue;
    const CircleId c = change.circles_created[first_created + i];
    const auto side = static_cast<std::uint8_t>(found_[i].index_of(p));
    const OpenSide open{c, side, found_[i].sites[side == 0 ? 1 : 0], found_[i].sites[side == 2 ? 1 : 2]};
    if (const CircleId other = circle_at(found_[i].facet, open.a, open.b, c); other.valid())
      connect_outwards(open, other);
    else
      outwards_.push_back(open);
  }
  for (const OpenSide& open : outwards_) {
    const auto is_same = [&](const OpenSide& s) { return s.a == open.a && s.b == open.b; };
    const auto cut = std::ranges::find_if(cut_off_, is_same);
    if (cut != cut_off_.end() && std::ranges::count_if(cut_off_, is_same) == 1 &&
        std::ranges::count_if(outwards_, is_same) == 1)
      connect_outwards(open, cut->circle);
    else
      connect_outwards(open, other_end(open));
  }
}

void Redivision::connect_outwards(const OpenSide& from, CircleId to) {
  state_.circles.set_beyond(from.circle, from.side, to);
  if (!to.valid()) return;
  const std::size_t side = state_.circles[to].opposite(from.a, from.b);
  state_.circles.set_beyond(to, side, from.circle);
  std::erase_if(cut_off_, [&](const OpenSide& s) { return s.circle == to && s.side == side; });
}

/// A circle of a and b on the facet, another one than `but`; none if there is none.
CircleId Redivision::circle_at(FacetId t, SiteId a, SiteId b, CircleId but) const {
  for (const CircleId c : state_.circles.of_site(a))
    if (c != but && state_.circles[c].facet == t && has_side(state_.circles[c], a, b)) return c;
  return CircleId();
}

//         v             The edge of the diagram between a and b, from a corner with p on, through one facet
//        / \    b       after the other. The part of it on a facet is one segment. If the facet has another
//       /___\___        circle of a and b, that is its end. Else it ends on a facet's edge, one of the two
//      / a   \          whose ends a and b are nearer to: not the one where it came in; or, in the first
//     u-------w         facet, the one where p is not nearer.
CircleId Redivision::other_end(const OpenSide& from) const {
  const auto [id, side, a, b] = from;
  const EmptyCircle& circle = state_.circles[id];
  const SiteId p = circle.sites[side];
  const Bisector beyond = state_.clipper.bisector_of(a, b);
  FacetId t = circle.facet;
  int entry = -1;
  for (std::size_t steps = 0; steps <= state_.mesh.num_facets(); ++steps) {
    if (const CircleId other = circle_at(t, a, b, id); other.valid()) return other;
    std::array<bool, 3> is_b;
    for (int i = 0; i < 3; ++i) {
      const EdgeLabel before = EdgeLabel::facet_edge(i == 0 ? 2 : i - 1), after = EdgeLabel::facet_edge(i);
      is_b[static_cast<std::size_t>(i)] =
          state_.clipper.beats_at({t, a, before, after, {state_.mesh.corner(t, i), 0}}, b, beyond);
    }
    int exit = -1;
    for (int e = 0; e < 3; ++e) {
      if (e == entry ||
          is_b[static_cast<std::size_t>(e)] == is_b[static_cast<std::size_t>(e == 2 ? 0 : e + 1)])
        continue;
      if (entry < 0 && is_taken(t, e, a, b, p)) continue;
      exit = e;
    }
    if (exit < 0) break;
    const FacetId across = state_.mesh.across(t, exit);
    entry = across.valid() ? same_edge(state_.mesh, t, exit, across) : -1;
    if (entry < 0) break;
    t = across;
  }
  return CircleId();
}

/// Is p nearer where the bisector of a and b meets an edge of the facet?
bool Redivision::is_taken(FacetId t, int edge, SiteId a, SiteId b, SiteId p) const {
  const EdgeLabel label = EdgeLabel::facet_edge(edge);
  const RoundedPoint point = state_.clipper.corner(t, label, a, b, state_.clipper.bisector_of(a, b));
  return state_.clipper.beats_at({t, a, label, EdgeLabel::bisector(b), point}, p,
                                 state_.clipper.bisector_of(a, p));
}

}  // namespace geom
