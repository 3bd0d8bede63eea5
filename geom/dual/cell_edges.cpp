#include "geom/dual/cell_edges.h"

#include <algorithm>

#include "geom/dual/chains.h"

namespace geom {

std::vector<CellEdges::Open>& CellEdges::OpenEnds::at(std::int64_t point) {
  return lists_[static_cast<std::uint64_t>(point) * 0x9e3779b97f4a7c15u >> 58];
}

void CellEdges::OpenEnds::clear() {
  for (std::vector<Open>& list : lists_) list.clear();
}

CellEdges::Open* CellEdges::OpenEnds::find(std::int64_t point, SiteId a, SiteId b) {
  std::vector<Open>& list = at(point);
  const auto known =
      std::ranges::find_if(list, [&](const Open& o) { return o.point == point && o.a == a && o.b == b; });
  return known == list.end() ? nullptr : &*known;
}

void CellEdges::OpenEnds::erase(const Open* end) {
  std::vector<Open>& list = at(end->point);
  list[static_cast<std::size_t>(end - list.data())] = list.back();
  list.pop_back();
}

void CellEdges::begin(SiteId p, std::span<const CircleId> own, std::span<const EmptyCircle> found) {
  p_ = p;
  found_ = found;
  star_.clear();
  for (const CircleId c : own) star_.push_back({c, {}});
  links_.clear();
  open_.clear();
}

void CellEdges::add(const CellPieces& pieces) {
  for (const CellPieces::Piece& piece : pieces.pieces) add_piece(pieces, piece);
}

void CellEdges::add_piece(const CellPieces& pieces, const CellPieces::Piece& piece) {
  const std::span<const PolygonCorner> corners = pieces.corners_of(piece);
  const SiteId a = piece.owner;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (!corners[k].edge.is_site()) continue;
    const SiteId b = corners[k].edge.site();
    if (a != p_ && (b == p_ || b < a)) continue;
    const SiteId first = std::min(a, b), second = std::max(a, b);
    const End one = end_at(piece.facet, first, second, corners[previous_corner(k, n)].edge);
    const End two = end_at(piece.facet, first, second, corners[next_corner(k, n)].edge);
    const End start = follow(one, first, second);
    if (start.kind == End::open && two.kind == End::open && start.place == two.place) {  // a closed curve
      if (const Open* end = open_.find(two.place, first, second)) open_.erase(end);
    } else {
      join(start, follow(two, first, second), first, second);
    }
  }
}

/// Where the edge of a and b ends on a facet: at an edge with this label.
CellEdges::End CellEdges::end_at(FacetId t, SiteId a, SiteId b, EdgeLabel label) const {
  if (label.is_site() && (label.site() != p_ || a == p_ || b == p_)) {
    const SiteId c = label.site();
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i].facet == t && found_[i].has_side(a, b) && found_[i].touches(c))
        return {End::found, static_cast<std::uint8_t>(found_[i].index_of(c)), static_cast<std::int64_t>(i)};
    return {};
  }
  if (label.is_site()) {
    for (std::size_t i = 0; i < star_.size(); ++i) {
      const EmptyCircle& circle = state_.circles[star_[i].id];
      if (circle.facet == t && circle.has_side(a, b)) return {End::own, 0, static_cast<std::int64_t>(i)};
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
CellEdges::End CellEdges::follow(const End& end, SiteId a, SiteId b) {
  if (end.kind != End::open) return end;
  const Open* known = open_.find(end.place, a, b);
  if (!known) return end;
  const End other = known->other;
  open_.erase(known);
  return other;
}

void CellEdges::join(const End& one, const End& two, SiteId a, SiteId b) {
  const auto leave_open = [&](const End& end, const End& other) {
    if (Open* known = open_.find(end.place, a, b))
      known->other = other;
    else
      open_.add({end.place, a, b, other});
  };
  if (one.kind == End::open) leave_open(one, two);
  if (two.kind == End::open) leave_open(two, one);
  if (one.kind == End::open || two.kind == End::open) return;
  if (one.kind == End::own) star_[static_cast<std::size_t>(one.place)].inside = two;
  if (two.kind == End::own) star_[static_cast<std::size_t>(two.place)].inside = one;
  if (one.kind != End::own && two.kind != End::own) links_.push_back({one, two});
}

/// Where the edge that comes through a circle of the removed site goes outside of its cell.
CellEdges::End CellEdges::outside(std::size_t own) const {
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

void CellEdges::join_across() {
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

void CellEdges::connect(std::span<const CircleId> created) const {
  const auto circle_of = [&](const End& end) {
    return end.kind == End::found     ? created[static_cast<std::size_t>(end.place)]
           : end.kind == End::present ? CircleId(static_cast<std::size_t>(end.place))
                                      : CircleId();
  };
  for (const auto& [one, two] : links_) {
    const CircleId first = circle_of(one), second = circle_of(two);
    if (first.valid()) state_.circles.set_beyond(first, one.side, second);
    if (second.valid()) state_.circles.set_beyond(second, two.side, first);
  }
}

}  // namespace geom
