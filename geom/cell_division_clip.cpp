// The division by clipping: each share by itself, from the whole facet. It needs nothing but the heirs.

#include <algorithm>
#include <numeric>

#include "geom/cell_division.h"

namespace geom {

void CellDivision::divide_by_clipping() {
  prepare();
  find_old_fragments();
  for (std::size_t i = 0; i < vacated_.size(); ++i) clip_shares(i);
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
void CellDivision::clip_shares(std::size_t vacated) {
  const FragmentId f = vacated_[vacated];
  const FacetId t = store_.facet(f);
  order_heirs(f);
  if (store_.whole(f) && inherits_whole(t)) return;
  std::array<PolygonCorner, 3> buffer;
  const std::span<const PolygonCorner> vacancy = store_.corners(f, buffer);
  for (const Heir i : order_) {
    const SiteId k = heirs_[i];
    const FragmentId old = old_fragment(vacated, i);
    const bool borders = std::ranges::any_of(
        vacancy, [&](const PolygonCorner& c) { return c.edge == EdgeLabel::bisector(k); });
    if (!borders && (old.valid() || yields_everywhere(i, vacancy))) continue;
    Share& share = add_share();
    share.joins = old;
    FacetPolygon& polygon = share.polygon;
    clipper_.start(polygon, t, k);
    const Bisector beyond = clipper_.bisector_of(k, p_);
    if (borders) clipper_.clip_beyond(polygon, p_, beyond);
    for (const Heir h : order_) {
      if (polygon.corners.empty()) break;
      if (h != i) clipper_.clip(polygon, heirs_[h], bisector(i, h));
    }
    misfit_ |= borders && polygon.corners.empty();
    if (polygon.corners.empty() || (!borders && !clipper_.beats_at(polygon, 0, p_, beyond)))
      --num_shares_;
    else
      for (std::size_t c = 0; c < polygon.corners.size(); ++c)
        corners_.push_back(cell_corner(t, k, polygon.corners, c));
  }
}

/// Is some other heir surely nearer than heir i at every corner of this polygon, hence all over it? Most
/// heirs that do not border a fragment are dismissed by this. "No" means nothing: the corners are rounded.
bool CellDivision::yields_everywhere(Heir i, std::span<const PolygonCorner> corners) const {
  return std::ranges::any_of(order_, [&](Heir h) {
    const Bisector& b = bisector(i, h);
    return h != i && std::ranges::all_of(corners, [&](const PolygonCorner& c) {
             return b(c.point.position) < -(b.error + b.length * c.point.tolerance);
           });
  });
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
  const Vec3 middle = clipper_.middle(store_.facet(vacated));
  Heir best = 0;
  for (Heir i = 1; i < heirs_.size(); ++i)
    if (bisector(best, i)(middle) < 0) best = i;
  std::swap(order_[0], order_[best]);
}

/// For a facet that p owned whole: does the first heir in order get all of it? Then that is noted.
bool CellDivision::inherits_whole(FacetId t) {
  const Heir first = order_.front();
  clipper_.start(polygon_, t, heirs_[first]);
  for (Heir h = 0; h < heirs_.size(); ++h)
    if (h != first && clipper_.classify(t, polygon_.owner, polygon_.corners, heirs_[h], bisector(first, h),
                                        beaten_) != Clip::untouched)
      return false;
  Share& share = add_share();
  clipper_.start(share.polygon, t, heirs_[first]);
  for (std::size_t c = 0; c < 3; ++c)
    corners_.push_back(cell_corner(t, share.polygon.owner, share.polygon.corners, c));
  return true;
}

}  // namespace geom
