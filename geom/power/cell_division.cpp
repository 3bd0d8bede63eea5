#include "geom/power/cell_division.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace geom {

void CellDivision::begin(SiteId p, std::span<const FragmentId> vacated, std::span<const SiteId> excluded) {
  vacated_.assign(vacated.begin(), vacated.end());
  heirs_.begin(p, excluded);
  for (const FragmentId f : vacated_)
    for (const PolygonCorner& corner : store_.corners(f))
      if (corner.edge.is_site() && heirs_.is_stranger(corner.edge.site())) heirs_.add(corner.edge.site());
}

void CellDivision::prepare() {
  num_shares_ = 0;
  misfit_ = false;
  corners_.clear();
  heirs_.pair_up();
}

CellDivision::Share& CellDivision::add_share() {
  if (num_shares_ == shares_.size()) shares_.emplace_back();
  Share& share = shares_[num_shares_++];
  share.joins = FragmentId();
  return share;
}

bool CellDivision::is_missing(SiteId j) const {
  const EdgeLabel own = EdgeLabel::bisector(j);
  return std::ranges::any_of(corners_, [&](const CellCorner& c) {
    return c.before != own && c.after != own &&  // where an edge is labelled j, j is no news
           clipper_.beats_at(c, j, clipper_.bisector_of(c.owner, j));
  });
}

double CellDivision::max_radius2() const {
  double result = -std::numeric_limits<double>::infinity();
  for (const CellCorner& c : corners_) {
    const PolygonCorner corner{c.point, c.after};
    result = std::max(result, clipper_.bound_power(c.facet, c.owner, {&corner, 1}));
  }
  return result;
}

void CellDivision::divide() {
  prepare();
  for (const FragmentId f : vacated_) clip_shares(f);
}

// Divides one fragment P of p, on facet t, among the heirs H, which contain every label of P. The share of k
// is
//
//     { x in t : p beats k at x, and k beats every other h in H at x }
//
// because where k beats all labels of P and p beats k, p beats them too, and the location is in P. If P has
// an edge labelled k, the share lies along that edge and joins the fragment that k has there. If not, it is
// an island, for on every edge of P another heir is nearer than k; then p beats k on all of { k beats every
// other h } or nowhere on it, and a k that has a fragment on t already has no share, because the two would
// make one convex fragment.
void CellDivision::clip_shares(FragmentId vacated) {
  const FacetId t = store_.facet(vacated);
  order_heirs(vacated);
  std::array<PolygonCorner, 3> buffer;
  const std::span<const PolygonCorner> vacancy = store_.corners(vacated, buffer);
  for (const Heir i : order_) {
    const SiteId k = heirs_[i];
    const FragmentId old = store_.find(k, t);
    const bool borders = std::ranges::any_of(
        vacancy, [&](const PolygonCorner& c) { return c.edge == EdgeLabel::bisector(k); });
    if (!borders && old.valid()) continue;
    Share& share = add_share();
    share.joins = old;
    FacetPolygon& polygon = share.polygon;
    clipper_.start(polygon, t, k);
    const Bisector beyond = clipper_.bisector_of(k, heirs_.p());
    if (borders) clipper_.clip_beyond(polygon, heirs_.p(), beyond);
    for (const Heir h : order_) {
      if (polygon.corners.empty()) break;
      if (h != i) clipper_.clip(polygon, heirs_[h], heirs_.bisector(i, h));
    }
    misfit_ |= borders && polygon.corners.empty();
    if (polygon.corners.empty() || (!borders && !clipper_.beats_at(polygon, 0, heirs_.p(), beyond)))
      --num_shares_;
    else
      for (std::size_t c = 0; c < polygon.corners.size(); ++c)
        corners_.push_back(cell_corner(t, k, polygon.corners, c));
  }
}

/// First the heirs that border the vacancy on its facet; if none does, the one that is nearest to the facet's
/// middle.
void CellDivision::order_heirs(FragmentId vacated) {
  order_.resize(heirs_.size());
  std::iota(order_.begin(), order_.end(), Heir{0});
  std::size_t front = 0;
  for (const PolygonCorner& corner : store_.corners(vacated)) {
    if (!corner.edge.is_site()) continue;
    for (std::size_t i = front; i < order_.size(); ++i)
      if (heirs_[order_[i]] == corner.edge.site()) std::swap(order_[i], order_[front++]);
  }
  if (front > 0) return;
  const FacetId t = store_.facet(vacated);
  const Location3 middle(clipper_.middle(t), clipper_.levels().middle(t));
  Heir best = 0;
  for (Heir i = 1; i < heirs_.size(); ++i)
    if (heirs_.bisector(best, i)(middle) < 0) best = i;
  std::swap(order_[0], order_[best]);
}

}  // namespace geom
