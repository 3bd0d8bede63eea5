#include "geom/dual/cut_edges.h"

#include <algorithm>
#include <array>

#include "geom/dual/chains.h"

namespace geom {

void CutEdges::cut(std::span<const CircleId> beaten) {
  cut_off_.clear();
  for (const CircleId c : beaten)
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
  std::erase_if(cut_off_,
                [&](const OpenSide& s) { return std::ranges::find(beaten, s.circle) != beaten.end(); });
}

// An edge of a and b that p has cut ends at p's cell, in new circles. On a facet it is one segment, so if
// another circle of a and b lies in the facet of a new one, these are its two ends. What is left of an edge
// that has lost one end ends in a new circle; if one such edge and one new circle are left, these belong
// together. In other cases the edge is followed.
void CutEdges::connect(SiteId p, std::span<const EmptyCircle> found, std::span<const CircleId> created) {
  outwards_.clear();
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].is_triangle()) continue;
    const CircleId c = created[i];
    const auto side = static_cast<std::uint8_t>(found[i].index_of(p));
    const OpenSide open{c, side, found[i].sites[side == 0 ? 1 : 0], found[i].sites[side == 2 ? 1 : 2]};
    if (const CircleId other = circle_at(found[i].facet, open.a, open.b, c); other.valid())
      join(open, other);
    else
      outwards_.push_back(open);
  }
  for (const OpenSide& open : outwards_) {
    const auto is_same = [&](const OpenSide& s) { return s.a == open.a && s.b == open.b; };
    const auto cut = std::ranges::find_if(cut_off_, is_same);
    if (cut != cut_off_.end() && std::ranges::count_if(cut_off_, is_same) == 1 &&
        std::ranges::count_if(outwards_, is_same) == 1)
      join(open, cut->circle);
    else
      join(open, other_end(open));
  }
}

void CutEdges::join(const OpenSide& from, CircleId to) {
  state_.circles.set_beyond(from.circle, from.side, to);
  if (!to.valid()) return;
  const std::size_t side = state_.circles[to].opposite(from.a, from.b);
  state_.circles.set_beyond(to, side, from.circle);
  std::erase_if(cut_off_, [&](const OpenSide& s) { return s.circle == to && s.side == side; });
}

/// A circle of a and b on the facet, another one than `but`; none if there is none.
CircleId CutEdges::circle_at(FacetId t, SiteId a, SiteId b, CircleId but) const {
  for (const CircleId c : state_.circles.of_site(a))
    if (c != but && state_.circles[c].facet == t && state_.circles[c].has_side(a, b)) return c;
  return CircleId();
}

//         v             The edge of the diagram between a and b, from a corner with p on, through one facet
//        / \    b       after the other. The part of it on a facet is one segment. If the facet has another
//       /___\___        circle of a and b, that is its end. Else it ends on a facet's edge, one of the two
//      / a   \          whose ends a and b are nearer to: not the one where it came in; or, in the first
//     u-------w         facet, the one where p is not nearer.
CircleId CutEdges::other_end(const OpenSide& from) const {
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
bool CutEdges::is_taken(FacetId t, int edge, SiteId a, SiteId b, SiteId p) const {
  const EdgeLabel label = EdgeLabel::facet_edge(edge);
  const RoundedPoint point = state_.clipper.corner(t, label, a, b, state_.clipper.bisector_of(a, b));
  return state_.clipper.beats_at({t, a, label, EdgeLabel::bisector(b), point}, p,
                                 state_.clipper.bisector_of(a, p));
}

}  // namespace geom
